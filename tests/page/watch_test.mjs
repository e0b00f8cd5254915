// A page of `gaitlab watch` in a browser: it follows the scenario, and keeps what the reader looks at.
// usage: watch_test.mjs PAGE SCENARIO, while `gaitlab watch SCENARIO` runs
import assert from "node:assert/strict";
import { appendFileSync, readFileSync, writeFileSync } from "node:fs";
import { close, open } from "./browser.mjs";

const [file, scenario] = process.argv.slice(2);
const { page, complaints } = await open(file, { link: "t=0.2" });
const run = () => page.evaluate(() => document.documentElement.dataset.watch);
const look = () => page.evaluate(() => ({
  t: window.gaitlab.page.state.t, joint: window.gaitlab.page.state.joint, pose: window.gaitlab.page.stage.view.kept().flat(),
}));
const renewed = (former) => page.waitForFunction(
  (n) => "ready" in document.documentElement.dataset && document.documentElement.dataset.watch !== n && window.gaitlab, former);

// The reader turns the camera and goes to another time.
await page.evaluate(() => {
  window.gaitlab.page.stage.view.look("top");
  window.gaitlab.page.goTo(0.75);
});
const first = await run(), seen = await look();
appendFileSync(scenario, "seed: 7\n");
await renewed(first);
const then = await look();
assert.equal(then.t, 0.75);
assert.equal(then.joint, seen.joint);
then.pose.forEach((x, k) => assert.ok(Math.abs(x - seen.pose[k]) < 1e-6, `pose ${then.pose} is not ${seen.pose}`));

// An error is announced, and the page keeps the run before it.
const good = readFileSync(scenario, "utf8"), second = await run();
writeFileSync(scenario, good.replace(/^duration:.*$/m, "duration: -1"));
await page.waitForSelector(".watch-note:not([hidden])");
assert.equal(await run(), second);
writeFileSync(scenario, `${good}\n`);
await renewed(second);
assert.equal(await page.locator(".watch-note").isVisible(), false);
assert.deepEqual(complaints, []);
await close();
