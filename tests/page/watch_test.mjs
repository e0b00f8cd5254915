// A page of `gaitlab watch` in a browser: it follows the scenario, and keeps what the reader looks at.
// usage: watch_test.mjs PAGE SCENARIO, while `gaitlab watch SCENARIO` runs
import assert from "node:assert/strict";
import { appendFileSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { basename, dirname, join } from "node:path";
import { close, open } from "./browser.mjs";

const [file, scenario] = process.argv.slice(2);
const renewed = (page, former) => page.waitForFunction(
  (n) => "ready" in document.documentElement.dataset && document.documentElement.dataset.watch !== n && window.gaitlab, former);
const { page, complaints } = await open(file, { link: "t=0.2" });
const run = () => page.evaluate(() => document.documentElement.dataset.watch);
const look = () => page.evaluate(() => ({
  t: window.gaitlab.page.state.t, joint: window.gaitlab.page.state.joint, span: [...window.gaitlab.page.state.span], theme: document.documentElement.dataset.theme,
  on: [...document.querySelectorAll('.tools [aria-pressed="true"]')].map((b) => b.id), heat: ["what", "order"].map((id) => document.getElementById(id).value),
  open: [...document.querySelectorAll('#checks [aria-expanded="true"]')].map((b) => b.textContent),
  pose: window.gaitlab.page.stage.view.kept().flat(),
}));

// The reader turns the camera, goes to another time, and changes everything else that can be changed.
for (const id of ["#theme", "#tint", "#forces", "#axes", '[data-check="stops"] button']) await page.click(id);
await page.selectOption("#what", "torque");
await page.selectOption("#order", "load");
await page.evaluate(() => {
  const { page: desk } = window.gaitlab;
  desk.stage.view.look("top");
  desk.choose(5);
  desk.zoom([0.5, 1.25]);
  desk.goTo(0.75);
});
const first = await run(), seen = await look();
appendFileSync(scenario, "seed: 7\n");
await renewed(page, first);
const then = await look();
assert.deepEqual(seen, { ...seen, t: 0.75, joint: 5, span: [0.5, 1.25], theme: "dark", heat: ["torque", "load"], open: ["Joints keep their ranges"] });
assert.ok(seen.on.includes("tint") && seen.on.includes("axes") && !seen.on.includes("forces"), String(seen.on));
assert.deepEqual({ ...then, pose: [] }, { ...seen, pose: [] });
then.pose.forEach((x, k) => assert.ok(Math.abs(x - seen.pose[k]) < 1e-6, `pose ${then.pose} is not ${seen.pose}`));

// An error is announced, and the page keeps the run before it.
const good = readFileSync(scenario, "utf8"), second = await run();
writeFileSync(scenario, good.replace(/^duration:.*$/m, "duration: -1"));
await page.waitForSelector(".watch-note:not([hidden])");
assert.equal(await run(), second);
// The message is a picture; that of two errors replaces it, and has more lines for any length of the path.
const shown = (height) => page.waitForFunction((than) => document.querySelector(".watch-note img").naturalHeight > than, height);
await shown(0);
const low = await page.evaluate(() => document.querySelector(".watch-note img").naturalHeight);
writeFileSync(scenario, `${good.replace(/^duration:.*$/m, "duration: -1")}nonsense: 1\n`);
await shown(low);
await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
assert.equal((await page.locator(".watch-note").boundingBox()).y, 0, "the error stays in view");
writeFileSync(scenario, `${good}\n`);
await renewed(page, second);
assert.equal(await page.locator(".watch-note").isVisible(), false);
assert.deepEqual(complaints, []);

// A page from a server follows, too, and states when it cannot.
let there = true; // false: the server does not find the stamp
const server = createServer((request, response) => {
  const name = new URL(request.url, "http://127.0.0.1").pathname;
  if (!there && name === "/stamp.svg") return response.writeHead(404).end();
  response.writeHead(200, { "Content-Type": name.endsWith(".svg") ? "image/svg+xml" : "text/html; charset=utf-8" });
  response.end(readFileSync(join(dirname(file), name)));
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
const served = await open(basename(file), { site: `http://127.0.0.1:${server.address().port}` });
const note = served.page.locator(".watch-note");
const third = await served.page.evaluate(() => document.documentElement.dataset.watch);
assert.equal(await note.isVisible(), false);
appendFileSync(scenario, "\n");
await renewed(served.page, third);
assert.deepEqual(served.complaints, []);
there = false;
await note.filter({ hasText: "does not follow" }).waitFor();
there = true;
await note.waitFor({ state: "hidden" });
assert.deepEqual(served.complaints.filter((text) => !text.includes("404")), []);
await served.close();
server.closeAllConnections();
server.close();
await close();
