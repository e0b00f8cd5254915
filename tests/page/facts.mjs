// The headline and the facts of report pages as a browser shows them: a name of a file per line in, a line of JSON per page out.
import { createInterface } from "node:readline";
import { close, open } from "./browser.mjs";

for await (const file of createInterface({ input: process.stdin })) {
  const { page, close: done } = await open(file, { webgl: false });
  console.log(JSON.stringify(await page.evaluate(() => ({
    headline: document.querySelector("#said").textContent,
    events: [...document.querySelectorAll("#events > li:not(.more)")].map((li) => li.textContent),
    why: document.querySelector("#why").textContent,
    facts: [...document.querySelectorAll("#facts dt")].map((dt) => [dt.textContent, dt.nextElementSibling.textContent]),
  }))));
  await done();
}
await close();
