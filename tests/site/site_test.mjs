// The site in a browser, as a reader opens it: from its files, without a network. usage: node site_test.mjs SITE
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { close, frames, open as opened } from "../page/browser.mjs";

const site = process.argv[2];
const pages = ["index.html", "docs/tutorials/feasible.html", "docs/equations.html", "docs/studies.html", "docs/reference/scenario.html", "search.html?q=verdict"];
after(close);

// Scripts of the site end before the load event, for which the browser waits.
const open = (page, options) => opened(join(site, page), { link: "", ready: "footer", ...options });

/** The least contrast of text in a page with its background, and the lightest and darkest background of text: luminances after WCAG. */
const colours = (page) => page.evaluate(() => {
  const numbers = (colour) => colour.match(/[\d.]+/g).map(Number);
  const luminance = (rgb) => rgb.map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4)).reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const over = ([r, g, b, a = 1], below) => [r, g, b].map((v, i) => a * v + (1 - a) * below[i]);
  const behind = (element) => {
    if (!element) return [255, 255, 255]; // the browser's own
    const colour = numbers(getComputedStyle(element).backgroundColor);
    return colour[3] === 0 ? behind(element.parentElement) : over(colour, behind(element.parentElement));
  };
  const found = { contrast: 21, lightest: 0, darkest: 1, worst: "" };
  for (const element of document.querySelectorAll("article p, article h1, article td, article pre, article pre span, article code, .sidebar-tree a")) {
    if (!element.checkVisibility() || !element.textContent.trim()) continue;
    const background = behind(element), [low, high] = [luminance(background), luminance(over(numbers(getComputedStyle(element).color), background))].sort((a, b) => a - b);
    const contrast = (high + 0.05) / (low + 0.05);
    if (contrast < found.contrast) Object.assign(found, { contrast, worst: `${element.outerHTML.slice(0, 100)}` });
    found.lightest = Math.max(found.lightest, luminance(background));
    found.darkest = Math.min(found.darkest, luminance(background));
  }
  return found;
});

/** Parts of the article that reach beyond its right border, and do not scroll. */
const wide = (page) => page.evaluate(() => {
  const right = document.querySelector("article").getBoundingClientRect().right;
  const scrolls = (element) => element && (/auto|scroll|hidden/.test(getComputedStyle(element).overflowX) || scrolls(element.parentElement.closest("article *")));
  return [...document.querySelectorAll("article *")]
    .filter((e) => !/^H\d$/.test(e.tagName)) // furo's headings have their padding outside
    .filter((e) => e.getBoundingClientRect().right > right + 0.5 && !scrolls(e.parentElement.closest("article *"))) // half a pixel: rounding
    .map((e) => `${e.outerHTML.slice(0, 100)}: ${e.getBoundingClientRect().right} of ${right}`);
});

for (const path of pages) for (const width of [390, 1366]) for (const colorScheme of ["light", "dark"]) test(`${path}, ${width} px, ${colorScheme}`, async () => {
  const { page, complaints, close: done } = await open(path, { width, colorScheme });
  assert.ok(await page.evaluate((w) => document.documentElement.scrollWidth <= w, width), "the page fits its window");
  assert.deepEqual(await wide(page), []);
  const { contrast, lightest, darkest, worst } = await colours(page);
  assert.ok(colorScheme === "dark" ? lightest < 0.1 : darkest > 0.8, `backgrounds have luminances ${darkest} to ${lightest}`);
  assert.ok(contrast > 3, `contrast ${contrast} of ${worst}`); // WCAG's least for large text; the colours of code are pygments'
  if (width === 1366) assert.ok(await page.isVisible(".project"), "the links to home and version are visible");
  assert.ok(await page.evaluate(() => document.body.getBoundingClientRect().top === 0), "no gap above the page");
  assert.deepEqual(complaints, []);
  await done();
});

// At this width a reader sees whole rows and lines: the scroll bar of a long table is far below.
test("no table or block of a page for users is cut, 1366 px", async () => {
  const read = ["index", "docs/tutorials/feasible", "docs/modules", "docs/library", "docs/benchmarks", "docs/validation", "docs/real-robot", "docs/reference/scenario", "docs/reference/plugins", "docs/reference/verdict"];
  for (const path of read) {
    const { page, close: done } = await open(`${path}.html`, { width: 1366 });
    const cut = await page.$$eval("article .table-wrapper, article pre", (all) => all.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent.slice(0, 60)));
    assert.deepEqual(cut, [], path);
    await done();
  }
});

test("a button to copy is seen in the dark", async () => {
  const { page, close: done } = await open("index.html", { width: 1366, colorScheme: "dark" });
  const shade = (colour) => Math.max(...colour.match(/[\d.]+/g).slice(0, 3).map(Number));
  const { icon, behind } = await page.$eval("button.copybtn", (button) => ({ icon: getComputedStyle(button).color, behind: getComputedStyle(button).backgroundColor }));
  assert.ok(shade(icon) > 100 && shade(behind) < 60, `${icon} on ${behind}`);
  await done();
});

for (const width of [390, 1366]) test(`the theme button, ${width} px`, async () => {
  const { page, complaints, close: done } = await open("index.html", { width, colorScheme: "light" });
  const button = page.locator(".theme-toggle:visible");
  assert.equal(await button.count(), 1);
  await button.click();
  assert.ok((await colours(page)).lightest < 0.1, "dark after a click");
  await page.goto(`file://${join(site, "docs/studies.html")}`);
  assert.ok((await colours(page)).lightest < 0.1, "the next page is dark, too");
  await page.locator(".theme-toggle:visible").click();
  assert.ok((await colours(page)).darkest > 0.8, "light after another click");
  assert.deepEqual(complaints, []);
  await done();
});

test("the table of contents follows the reader", async () => {
  const { page, complaints, close: done } = await open("docs/equations.html", { width: 1366 });
  await page.evaluate(() => document.querySelector("#contact-eq-12").scrollIntoView());
  await page.waitForSelector('.toc-tree .scroll-current > a[href="#contact-eq-12"]');
  await frames(page, 1);
  assert.deepEqual(complaints, []);
  await done();
});

for (const [path, least] of [["equations", 25], ["real-robot", 2], ["mujoco", 1], ["files", 1], ["numbers", 1]]) test(`the equations of ${path} are set`, async () => {
  const { page, complaints, close: done } = await open(`docs/${path}.html`, { width: 1366 });
  const made = await page.$$eval("article .math", (all) => all.map((e) => ({ set: Boolean(e.querySelector(".katex-html")), error: e.querySelector(".katex-error")?.title })));
  assert.ok(made.length >= least, `${made.length} equations`);
  assert.deepEqual(made.filter((e) => !e.set || e.error), []);
  await page.evaluate(() => document.fonts.ready);
  assert.ok(await page.evaluate(() => document.fonts.check("16px KaTeX_Main") && document.fonts.check("italic 16px KaTeX_Math")), "in the fonts of KaTeX");
  assert.deepEqual(complaints, []); // KaTeX names doubtful TeX on the console
  await done();
});

/** Titles of what the search finds. */
async function searched(query, check = () => {}) {
  const { page, complaints, close: done } = await open(`search.html?q=${encodeURIComponent(query)}`, { width: 390 });
  const found = await page.$$eval("#search-results li", (all) => all.map((li) => ({ href: li.querySelector("a").getAttribute("href"), group: li.querySelector(".group").textContent, excerpt: li.querySelector("p").textContent })));
  await check(page, found);
  assert.deepEqual(complaints, []);
  await done();
  return found;
}

test("the search: users' pages first, with excerpts", async () => {
  const found = await searched("no-load speed of the motors", async (page, all) => {
    await page.click("#search-results a");
    await page.waitForURL(/docs/);
    assert.ok(await page.isVisible("article"));
    assert.ok(all.length > 0);
  });
  assert.match(found[0].excerpt, /motor/i);
  const verdict = await searched("verdict"), late = verdict.map((f) => /^(Project|Decision|File)$/.test(f.group));
  assert.ok(verdict.length > 10 && late.includes(true));
  assert.deepEqual(late, [...late].sort(), "decisions and changes stand behind");
  assert.match(verdict[0].href, /^docs\/(reference\/verdict|tutorials\/feasible)\.html/);
  assert.ok(verdict.filter((f) => f.group !== "File").every((f) => f.excerpt), "every page has an excerpt");
});

// Words that a user types, and a page that must be among the first three; pages of developers are not. (The gate has no gallery.)
const asked = {
  torque: "docs/reference/plugins.html", servo: "docs/tutorials/motors.html", friction: "docs/reference/scenario.html", infeasible: "docs/errors.html", "current limit": "docs/glossary.html",
  slope: "docs/glossary.html", python: "docs/python.html", install: "docs/overview.html", MuJoCo: "docs/mujoco.html", voltage: "docs/reference/plugins.html",
  gear: "docs/reference/plugins.html", wheel: "docs/modules.html", heat: "docs/reference/verdict.html", slip: "docs/reference/scenario.html", approve: "docs/commands.html",
  tolerance: "docs/real-robot.html", sweep: "docs/studies.html", ramp: "docs/reference/plugins.html", keyframes: "docs/reference/plugins.html"
};
test("the search: words of a user", async () => {
  for (const [query, page] of Object.entries(asked)) {
    const first = (await searched(query)).slice(0, 3);
    assert.ok(first.some((f) => f.href.startsWith(page)), `${query}: ${first.map((f) => f.href)}`);
    assert.ok(!/^(Conventions|Project|Decision|File)$/.test(first[0].group), `${query}: ${first[0].href}`);
  }
});

test("the search: what nobody wrote, and what is no text", async () => {
  assert.deepEqual(await searched("xyzzyqwerty", async (page) => assert.match(await page.textContent("#search-count"), /No page/)), []);
  assert.deepEqual(await searched("  "), []);
  await searched("<img src=x onerror=alert(1)> .*(["); // markup and the signs of regular expressions
});
