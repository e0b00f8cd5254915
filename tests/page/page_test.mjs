// The report page in a browser. usage: node page_test.mjs NAME=FILE...
// feasible, infeasible, failed, open (not judged), built: pages by what they say; markup: one of a scenario with markup in its text; csv, old
// (rows alone), jointless, built_ball: what there is little of; castor, motorless: joint 0 has no motor, none has; cured: a run with a remedy; fall, current: runs that fail in other ways; torque: of torque sources; pair, robots, ball, pair_second: two runs; strayed: of a golden.
// trace: CSV of the feasible run with body.* columns.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, test } from "node:test";
import { close, columnsOf, frames, metaOf, modules, open, pageTexts } from "./browser.mjs";

const files = Object.fromEntries(process.argv.slice(2).map((a) => a.split(/=(.*)/s)));
const { trace, ...pages } = files;
const axe = readFileSync(modules.resolve("axe-core/axe.min.js"), "utf8");
const said = { feasible: /^Feasible/, infeasible: /^Not feasible/, failed: /^The run ended early/, "not run": /^Built, not run$/, "not judged": /^Not judged$/ };
const saidOf = (meta) => said[meta.outcome === "not run" ? "not run" : meta.verdict.verdict];
const verdicts = { feasible: "feasible", infeasible: "infeasible", failed: "failed", open: "not judged" };
after(close);

// In CI every fourth test, others at each landing: without a GPU the drawing takes most of the time.
const quarter = process.env.GAITLAB_QUARTER;
let number = 0;
const leftOut = () => quarter !== undefined && number++ % 4 !== Number(quarter);
/** A test on an open page that must not complain. */
const on = (name, file, options, body) => file && !leftOut() && test(name, async (parts) => {
  const { page, complaints, close: done } = await open(file, options);
  try {
    await body(page, metaOf(file), parts);
    assert.deepEqual(complaints, []);
  } finally {
    await done();
  }
});
/** Options of tests that look at no picture of the robot: without a GPU, to draw it costs more than most of them. */
const flat = { webgl: false };
const factsOf = async (page) => Object.fromEntries(await page.$$eval("#facts > div", (all) => all.map((d) => [d.querySelector("dt").textContent, d.querySelector("dd").textContent])));
const state = (page) => page.evaluate(() => ({ ...window.gaitlab.page.state }));
const words = { pass: "pass", warn: "warning", fail: "fail", "too close": "too close", "not judged": "not judged" };
const wordOf = (c) => c && (c.id === "stability" && c.status === "pass" ? "a note" : words[c.status]);
/** A copy of a page with another verdict. */
const changed = (file, verdict) => {
  if (!file) return undefined;
  const folder = mkdtempSync(join(tmpdir(), "page-")), copy = join(folder, "report.html"), meta = metaOf(file);
  Object.assign(meta.verdict, verdict);
  writeFileSync(copy, readFileSync(file, "utf8").replace(/(id="meta">)[^]*?(<\/script>)/, (_, begin, end) => begin + JSON.stringify(meta).replaceAll("<", "\\u003c") + end));
  after(() => rmSync(folder, { recursive: true }));
  return copy;
};
const failing = (meta) => meta.verdict.checks.find((c) => c.id === meta.verdict.decided_by) ?? meta.verdict.checks.find((c) => c.status === "fail");
const nameOf = (meta, c) => (c.part === "dock" ? `${c.worst}'s dock` : c.part === "foot" ? meta.feet.find((f) => f.name === c.worst)?.title ?? c.worst : c.worst);
const near = (a, b, off, what) => assert.ok(Math.abs(a - b) <= off, `${what}: ${a}, expected ${b}`);

for (const [name, file] of Object.entries(pages)) {
  // One page for three tests: without a GPU, to open it and to draw in it costs more than they do.
  on(name, file, { width: 390, height: 844 }, async (page, meta, part) => {
    await part.test(`${name}: fits narrow windows`, async () => {
      for (const width of [390, 320]) {
        await page.setViewportSize({ width, height: 844 });
        await page.waitForFunction((w) => window.innerWidth === w, width);
        await frames(page, 3);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= width, `${wide} px of ${width}`);
        if (await page.isVisible("#time")) assert.ok((await page.locator("#time").boundingBox()).width > 0.7 * width, "the slider is wide enough for a finger");
      }
    });
    await page.setViewportSize({ width: 1440, height: 900 });
    await page.waitForFunction(() => window.innerWidth === 1440);
    await frames(page, 3);

    if (!meta.overlay) await part.test(`${name}: says what it found`, async () => {
      assert.match(await page.textContent("#said"), saidOf(meta));
      if (verdicts[name]) assert.equal(meta.verdict.verdict, verdicts[name]);
      assert.equal(await page.textContent("#name"), meta.name);
      assert.equal(await page.title(), `${meta.name}: gaitlab report`);
      if (meta.outcome === "not run") return;
      const rows = await page.$$eval("#checks [data-check]", (all) => all.map((r) => [r.dataset.check, r.querySelector(".mark").textContent, r.querySelector(".what").textContent]));
      assert.deepEqual(rows, meta.verdict.checks.map((c) => [c.id, wordOf(c), c.title]));
    });

    await part.test(`${name}: accessible, light and dark`, async () => {
      await page.evaluate(axe); // by the debugger: the page's own policy lets no script in
      await page.evaluate(() => document.querySelectorAll("details").forEach((d) => { d.open = true; }));
      for (const theme of ["light", "dark"]) {
        const found = await page.evaluate(async (t) => {
          window.gaitlab.page.theme(t);
          const { violations } = await window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21aa"] });
          return violations.map((v) => `${v.id}: ${v.nodes.map((n) => `${n.target} ${n.any[0]?.message ?? ""}`).join("; ")}`);
        }, theme);
        assert.deepEqual(found, [], theme);
      }
    });
  });

  on(`${name}: without WebGL the rest of it works`, file, { webgl: false, link: "paused&faces" }, async (page, meta) => {
    assert.match(await page.textContent("#stage"), /cannot draw in 3D/);
    if (said[name]) assert.match(await page.textContent("#said"), said[name]);
    for (const key of ["f", "c", "n", "a", "1", "j", "d"]) await page.keyboard.press(key);
    for (const button of ["#card", "#film"]) assert.ok(await page.isHidden(button), button);
    if (meta.joints.length) assert.equal(await page.$eval("#joint", (list) => list.options.length), meta.joints.length);
    assert.ok(await page.isHidden("#faces"));
  });
}

on("markup: text of a scenario stays text", pages.markup, flat, async (page, meta) => {
  assert.match(meta.scenario, /<\/script><script>window.taken = 1/);
  assert.equal(await page.textContent("#scenario"), meta.scenario);
  assert.equal(await page.evaluate(() => window.taken), undefined);
});

for (const name of ["feasible", "infeasible"]) {
  const file = pages[name];
  on(`${name}: keys`, file, {}, async (page, meta) => {
    await page.locator("#view").focus();
    await page.keyboard.press("Home");
    assert.equal((await state(page)).t, 0);
    await page.keyboard.press("ArrowRight");
    near((await state(page)).t, meta.period, 1e-9, "one row on");
    await page.keyboard.press("Shift+ArrowRight");
    near((await state(page)).t, meta.period + 0.1, 1e-9, "0.1 s on");
    await page.keyboard.press("End");
    near((await state(page)).t, meta.duration, meta.period, "the end");
    const { joint } = await state(page);
    await page.keyboard.press("]");
    assert.equal((await state(page)).joint, (joint + 1) % meta.joints.length);
    await page.keyboard.press("[");
    assert.equal((await state(page)).joint, joint);
    await page.keyboard.press("d");
    assert.equal(await page.getAttribute("html", "data-theme"), "dark");
    for (const [key, button] of [["f", "#follow"], ["l", "#tint"], ["c", "#forces"], ["b", "#balance-marks"], ["t", "#travel"], ["n", "#faces"], ["a", "#axes"], ...(meta.docks.length ? [["k", "#rings"]] : [])]) {
      const before = await page.getAttribute(button, "aria-pressed");
      await page.keyboard.press(key);
      assert.notEqual(await page.getAttribute(button, "aria-pressed"), before, key);
    }
    await page.keyboard.press("?");
    assert.ok(await page.isVisible("#keylist"));
    for (const key of ["1", "2", "3", "4", "j"]) await page.keyboard.press(key);
    await page.keyboard.press("z");
    assert.deepEqual((await state(page)).span, [0, await page.evaluate(() => window.gaitlab.page.recording.end)]);
  });

  on(`${name}: the slider sets the time`, file, flat, async (page, meta) => {
    const t = 0.7 * meta.duration;
    await page.$eval("#time", (e, x) => { e.value = String(x); e.dispatchEvent(new Event("input", { bubbles: true })); }, t);
    near((await state(page)).t, t, 1e-9, "time");
    assert.match(await page.textContent("#clock"), new RegExp(`^${t.toFixed(2)} /`));
  });

  on(`${name}: a click on a hinge chooses its joint`, file, {}, async (page) => {
    const hit = await page.evaluate(() => {
      const { stage, recording, state: now } = window.gaitlab.page, { view } = stage, r = view.canvas.getBoundingClientRect();
      for (let j = 0; j < recording.meta.joints.length; j++) {
        const at = view.place(j), x = r.left + at[0], y = r.top + at[1], k = view.pick(x, y);
        if (k >= 0 && k !== now.joint && document.elementFromPoint(x, y) === view.canvas) return { x, y, k };
      }
      return null;
    });
    assert.ok(hit, "no hinge is in sight");
    await page.mouse.click(hit.x, hit.y);
    assert.equal((await state(page)).joint, hit.k);
    assert.equal(await page.inputValue("#joint"), String(hit.k));
  });

  on(`${name}: a check goes to its part and time`, file, flat, async (page, meta) => {
    const places = meta.verdict.checks.filter((c) => c.worst !== null && c.from !== null && c.status !== "not judged");
    assert.ok(places.length > 0);
    for (const check of places) {
      const title = page.locator(`[data-check="${check.id}"] button`);
      await title.click();
      const { joint, t } = await state(page);
      if (check.part === "joint") assert.equal(meta.joints[joint].name, check.worst);
      if (check.part === "dock") assert.equal(`m${meta.joints[joint].module}`, check.worst);
      assert.ok(t > check.from - 0.5 * meta.period && t < check.to + 0.5 * meta.period, `${check.id}: ${t}, ${check.from} to ${check.to}`);
      assert.equal(await title.getAttribute("aria-expanded"), "true");
      assert.ok((await page.locator(`[data-check="${check.id}"] + tr`).textContent()).includes(nameOf(meta, check)), check.id);
    }
  });

  // A peak lies between two control ticks, and its number belongs to the row where it is largest: no other row in the stretch has more.
  on(`${name}: a peak is shown at the row where it is largest`, file, flat, async (page, meta) => {
    const peaks = [["speed", "speed"], ["gear_peak", "torque"]].flatMap(([id, quantity]) => meta.verdict.checks.filter((c) => c.id === id && c.worst !== null && c.from !== null && c.status !== "not judged").map((c) => [c, quantity]));
    assert.ok(peaks.length > 0);
    for (const [check, quantity] of peaks) {
      await page.locator(`[data-check="${check.id}"] button`).click();
      const [at, most] = await page.evaluate(([c, what]) => {
        const { recording, state: { t, joint } } = window.gaitlab.page, values = recording.channel(`joint.${joint}.${what}`), within = [...recording.times.keys()].filter((i) => recording.times[i] > c.from - 1e-6 && recording.times[i] < c.to + 1e-6);
        return [Math.abs(values[recording.row(t)]), Math.max(...within.map((i) => Math.abs(values[i])))];
      }, [check, quantity]);
      assert.equal(at, most, check.id);
    }
  });

  on(`${name}: checks that were not judged are one line`, file, flat, async (page, meta) => {
    const open = meta.verdict.checks.filter((c) => c.status === "not judged"), line = page.locator("#checks .fold button");
    assert.ok(open.length > 1);
    assert.equal(await line.textContent(), `${open.length} checks not judged`);
    const told = /(\d+) checks were not judged/.exec(await page.innerText("body"));
    if (told) assert.equal(Number(told[1]), open.length, "the banner counts as the list does");
    for (const { id } of open) assert.ok(await page.isHidden(`[data-check="${id}"]`), id);
    await line.click();
    assert.equal(await line.getAttribute("aria-expanded"), "true");
    for (const { id } of open) assert.ok(await page.isVisible(`[data-check="${id}"]`), id);
  });

  on(`${name}: plays`, file, {}, async (page) => {
    await page.keyboard.press("Home");
    await page.click("#play");
    await page.waitForFunction(() => window.gaitlab.page.state.t > 0.2);
    await page.click("#play");
    assert.equal((await state(page)).playing, false);
  });

  on(`${name}: prints`, file, { link: "paused&theme=dark" }, async (page) => {
    const pdf = await page.pdf({ format: "A4", printBackground: true });
    assert.ok(pdf.subarray(0, 5).toString() === "%PDF-" && pdf.length > 50_000, `${pdf.length} bytes`);
    assert.equal(await page.getAttribute("html", "data-theme"), "dark", "as it was before");
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    assert.ok(await page.evaluate(() => document.querySelector("#stage img").naturalWidth > 100), "an image of the robot");
    // Marks of a size in pixels have it on paper, too: a picture of 262 px in an angle of 32 degrees.
    const [pixel, height] = await page.evaluate(() => [window.gaitlab.page.stage.view.gauges.colours.pixel.value, document.getElementById("stage").clientHeight]);
    near(pixel * height, 2 * Math.tan(Math.PI * 16 / 180), 1e-3, `a pixel of ${height}`);
    assert.equal(await page.getAttribute("html", "data-theme"), "light");
  });
}

for (const name of ["infeasible", "current", "fall"]) {
  on(`${name}: on paper a failed check is on one page, and no page is empty`, pages[name], flat, async (page, meta) => {
    const texts = pageTexts(await page.pdf({ format: "A4", printBackground: true })), bare = (text) => text.normalize("NFKC").replace(/\s/g, "");
    texts.forEach((text, k) => assert.ok(text.length > 10, `page ${k + 1} of ${texts.length}`));
    const found = await page.$$eval("#checks tr.is-fail:not(.detail)", (all) => all.map((row) => [row.querySelector(".what").textContent, [...row.nextElementSibling.querySelectorAll(".why, .short, .try")].map((p) => p.textContent)]));
    assert.equal(found.length, meta.verdict.counts.fail);
    for (const [title, lines] of found) {
      assert.ok(lines.length > 0);
      assert.equal(texts.filter((text) => [title, ...lines].every((one) => text.includes(bare(one)))).length, 1, title);
    }
  });
}

on("feasible: a link leads to joint, time and theme", pages.feasible, { ...flat, link: "joint=m3/passive&t=1.25&theme=dark" }, async (page, meta) => {
  const { joint, t, playing } = await state(page);
  assert.deepEqual([meta.joints[joint].name, t, playing], ["m3/passive", 1.25, false]);
  assert.equal(await page.getAttribute("html", "data-theme"), "dark");
});

on("feasible: opens paused at what is tightest", pages.feasible, { ...flat, link: "" }, async (page, meta) => {
  const { playing, joint, t } = await state(page), { tightest, checks, rests_on } = meta.verdict, check = checks.find((c) => c.id === tightest);
  assert.equal(playing, false);
  if (check.part === "joint") assert.equal(meta.joints[joint].name, check.worst);
  if (check.from !== null) assert.ok(t > check.from - meta.period && t < check.to + meta.period, `${t}; ${JSON.stringify(check)}`);
  assert.equal(await page.textContent("#said"), "Feasible with these motors");
  assert.ok((await page.textContent("#why")).startsWith(`Over ${rests_on}: `));
  const facts = await factsOf(page);
  assert.ok(facts.Tightest.includes(check.worst === null ? check.title : nameOf(meta, check)), `${facts.Tightest}; ${JSON.stringify(check)}`);
});

on("infeasible: what is worst, when, how much is missing", pages.infeasible, flat, async (page, meta) => {
  const facts = await factsOf(page), check = failing(meta), { longest, why, demand } = meta.verdict;
  assert.ok((await page.textContent("#why")).toLowerCase().startsWith(why.toLowerCase().replace(/[.]$/, "")), "the terminal's sentence");
  assert.ok(facts.Worst.startsWith(check.worst));
  const share = (joint) => joint.voltage + joint.current;
  assert.ok(share(longest) > 0 && facts["Longest at a limit"].startsWith(longest.joint));
  near(Number(/^[\d.]+/.exec(facts.When)[0]), check.from, 6e-3, "when");
  const { missing } = meta.verdict.checks.find((c) => c.status === "fail" && c.missing);
  assert.ok(missing.startsWith(/^[\d.]+ \S+/.exec(facts.Missing)[0]), `${facts.Missing}; ${missing}`);
  const asked = await page.$$eval("#demand tbody tr", (all) => all.map((r) => r.firstChild.textContent));
  assert.ok(asked.length > 0 && asked.every((name) => demand.joints.some((d) => d.joint === name)));
  const advice = await page.textContent(`[data-check="${check.id}"] + tr .try`);
  assert.ok(advice.startsWith("Try: ") && advice.includes((check.remedy || check.advice).replace(/[.]$/, "")));
});

for (const name of ["infeasible", "current", "fall"]) {
  on(`${name}: the failed checks are one line in the order of time, and each goes to its time and part`, pages[name], {}, async (page, meta) => {
    const { verdict: { events, checks } } = meta, checkOf = (e) => checks.find((c) => c.id === e.check), called = (e) => e.part && nameOf(meta, { ...checkOf(e), worst: e.part });
    assert.ok(events.length > 0);
    const entries = page.locator("#happened .events > li:not(.more)"), texts = await entries.allTextContents();
    assert.deepEqual(await page.locator("#events > li:not(.more)").allTextContents(), texts, "the card has the same line");
    assert.equal(texts.length, events.length);
    events.forEach((e, k) => assert.ok(texts[k].startsWith(`${e.time.toFixed(2)} s ${e.part ? `${called(e)} ` : ""}`), texts[k]));
    // Every period: rows at that limit, period by period.
    const period = meta.cycle?.period ?? 1 / meta.frequency;
    for (const [k, e] of events.entries()) {
      const code = ["voltage", "current"].indexOf(e.check) + 1, joint = meta.joints.findIndex((j) => j.name === e.part), count = Math.floor((meta.duration - e.time) / period + 1e-6);
      const met = code > 0 && await page.evaluate(([j, limit, from, T]) => {
        const { recording } = window.gaitlab.page, at = recording.channel(`joint.${j}.saturation`);
        return [...new Set([...recording.times].flatMap((t, i) => (at[i] === limit && t >= from ? [Math.floor((t - from) / T)] : [])))];
      }, [joint, code, e.time, period]);
      assert.equal(texts[k].includes("every period"), !!met && count > 1 && Array.from({ length: count }, (_, n) => n).every((n) => met.includes(n)), texts[k]);
    }
    // In a narrow window not all of them fit; a button shows the others.
    await page.setViewportSize({ width: 320, height: 844 });
    const more = page.locator("#happened .more button"), hidden = () => entries.evaluateAll((all) => all.filter((li) => li.hidden).length);
    await page.waitForFunction((all) => {
      const list = document.querySelector("#happened .events"), shown = [...list.children].filter((li) => !li.hidden);
      return window.innerWidth === 320 && (all < 4 || shown.length <= all) && shown.at(-1).getBoundingClientRect().bottom <= list.getBoundingClientRect().bottom + 1;
    }, events.length);
    if (await hidden()) {
      assert.equal(await more.textContent(), `and ${await hidden()} more`);
      await more.press("Enter");
      assert.ok(await page.evaluate(() => document.activeElement.closest("#happened li")), "the focus is on the first of the others");
    }
    assert.equal(await hidden(), 0);
    for (const [k, e] of events.entries()) {
      await entries.nth(k).locator("button").press("Enter");
      const { t } = await state(page), { part } = checkOf(e);
      assert.ok(t > e.time - meta.period && t < e.time + 0.02 + meta.period, `${t}, ${e.time}`);
      // A joint has numbers after its name; the robot as a whole has no name.
      await page.waitForFunction(([whole, what]) => {
        const tag = document.getElementById("tag");
        return whole === null ? tag.hidden : !tag.hidden && tag.querySelector("b").textContent === whole && (tag.textContent !== whole) === what;
      }, [called(e), part === "joint"]);
    }
    await page.keyboard.press("]");
    await page.waitForFunction(() => /N m/.test(document.getElementById("tag").textContent) && !document.getElementById("tag").hidden);
  });
}

const unstable = "the controller is unstable from 0.03 s on";
on("an unstable controller is the only finding of the card, and its checks have no advice", changed(pages.infeasible, { unstable, why: unstable }), flat, async (page, meta) => {
  assert.ok(meta.verdict.counts.fail > 1 && meta.verdict.chosen_motors, "there is more to say of a stable run");
  const texts = await Promise.all(["#said", "#why", "#events", "#happened", "#aside", "#facts"].map((id) => page.textContent(id)));
  assert.deepEqual(texts, ["Not feasible", "The controller is unstable from 0.03 s on.", "", "", "", ""]);
  assert.equal(await page.locator("#checks .try").count(), 0, "no advice such as larger gains");
});

// Reasons as of report/verdict: a run that is too short, a number that is impossible, a value within its error of the limit.
const lacking = "2 s contain only 0.5 of the 3 periods of 4 s that a gait needs";
const impossible = "body 'a' of link (0.1 kg) has a moment of inertia of 1 kg m^2, as much as a ring of radius 3.2 m, but the body's extent is 0.12 m; give values that are physically possible";
for (const [name, verdict, first, rest] of [
  ["too short", { why: `${lacking}; take duration: 12; and the torque of joint m1/active is off; take physics.accuracy: 0.001; so far: 8 of 16 joints stop`, retry: ["duration=12", "physics.accuracy=0.001"] }, `${lacking}.`, " The torque of joint m1/active is off. So far: 8 of 16 joints stop."],
  ["impossible", { why: impossible }, "Body 'a' of link (0.1 kg) has a moment of inertia of 1 kg m^2, as much as a ring of radius 3.2 m.", " But the body's extent is 0.12 m. Give values that are physically possible."],
  ["too close", { why: "joint m6/active may be at its limit", reason_code: "too close" }, "The value of the check “Current suffices” is too close to its limit.", " Joint m6/active may be at its limit."],
]) {
  const file = changed(pages.current, { verdict: "not judged", reason_check: "current", ...verdict });
  on(`not judged, ${name}: a short sentence states what is missing, and a command supplies it if one is known`, file, flat, async (page) => {
    assert.equal(await page.textContent("#said"), "Not judged");
    const place = `${resolve(file).replace(/report.html$/, "")}scenario.resolved.yaml`, command = verdict.retry ? [`gaitlab run ${place} ${verdict.retry.map((one) => `--set ${one}`).join(" ")}`] : [];
    assert.ok(first.split(" ").length <= 25);
    assert.deepEqual(await page.locator("#why code").allTextContents(), command);
    assert.equal(await page.textContent("#why"), `${first}${command.map((one) => ` Judge by ${one}`).join("")}${rest}`);
  });
}

on("open: a short sentence states what is missing", pages.open, flat, async (page) => assert.equal(await page.textContent("#why"), "Nothing drives the joints."));

// The joint of the row with the largest share of the time at a limit, by the rows that are drawn.
on("infeasible: the joint that is longest at a limit is that of the rows, too", pages.infeasible, flat, async (page, meta) => {
  const shares = await page.evaluate(() => {
    const { recording } = window.gaitlab.page;
    return recording.meta.joints.map((_, j) => recording.channel(`joint.${j}.saturation`).filter((v, i) => v > 0 && i >= recording.judged).length);
  });
  const joint = meta.joints.findIndex((j) => j.name === meta.verdict.longest.joint);
  assert.ok(shares[joint] >= 0.97 * Math.max(...shares), `${shares}; ${joint}`); // a row is 5 ms of its stretch: both ends of some thirty
});

// A number in red is beyond the limit beside it.
for (const name of ["infeasible", "fall", "current"]) {
  on(`${name}: what fails is beyond the limit that it stands beside`, pages[name], flat, async (page, meta) => {
    const failed = meta.verdict.checks.filter((c) => c.status === "fail");
    assert.ok(failed.length > 0);
    for (const c of failed) if (c.value !== null && c.limit !== null) assert.ok(c.least ? c.value < c.limit : c.value > c.limit, `${c.id}: ${c.value}, limit ${c.limit}`);
  });

  on(`${name}: opens paused where it fails`, pages[name], { ...flat, link: "" }, async (page, meta) => {
    const { playing, joint, t } = await state(page), check = failing(meta);
    assert.equal(playing, false);
    assert.ok(t > check.from - meta.period && t < check.to + meta.period, `${t}, ${check.from} to ${check.to}`);
    if (check.part !== "joint") return;
    assert.equal(meta.joints[joint].name, check.worst);
    if (!["voltage", "current"].includes(check.id)) return;
    const saturated = await page.evaluate(() => {
      const { recording, state: now } = window.gaitlab.page;
      return recording.channel(`joint.${now.joint}.saturation`)[recording.row(now.t)];
    });
    assert.ok(saturated > 0, "the motor is at its limit at the row shown");
  });
}

// Contrast of WCAG 2, 1.4.11, of what lies next to each other: body and rim, rim and the colour of the load.
on("loads are readable on every body", Object.values(pages)[0], flat, async (page) => {
  const { bodies, rim, colours, stops } = await page.evaluate(() => {
    const { bodyColours, rim: around, ringLoad, ringGradient } = window.gaitlab.colours, shares = Array.from({ length: 101 }, (_, k) => k / 100), themes = ["light", "dark"];
    return { bodies: bodyColours, rim: around, colours: themes.map((t) => shares.map((x) => ringLoad(t, x))), stops: themes.map(ringGradient) };
  });
  const linear = (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const contrast = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);
  const rgb = (hex) => [hex >> 16, (hex >> 8) & 255, hex & 255];
  for (const [n, theme] of ["light", "dark"].entries()) {
    for (const name of ["active", "passive", "other"]) assert.ok(contrast(rgb(bodies[theme][name]), rim) >= 3, `${theme}, ${name}`);
    colours[n].forEach((c, k) => assert.ok(contrast(c, rim) >= 3, `${theme}, ${k} %: ${contrast(c, rim)}`));
    const lightness = colours[n].map(luminance), up = lightness[100] > lightness[0] ? 1 : -1;
    lightness.slice(1).forEach((l, k) => assert.ok(up * (l - lightness[k]) >= -0.004, `${theme}: the lightness is monotonic, ${k} %`));
    // The legend is a gradient through the same colours.
    for (const [, c, x] of stops[n].matchAll(/rgb\(([\d,]+)\) ([\d.]+)%/g)) assert.deepEqual(c.split(",").map(Number), colours[n][Math.round(Number(x))]);
  }
});

for (const name of ["infeasible", "current", "fall"]) {
  on(`${name}: the camera is near the part that fails, and a key leads to the next problem`, pages[name], { link: "" }, async (page, meta) => {
    const near = () => page.evaluate(() => {
      const { stage: { view }, state: { joint, t } } = window.gaitlab.page, { clientWidth: w, clientHeight: h } = view.canvas, [x, y] = view.place(joint), [across, up] = [x / w, y / h];
      return { across, up, joint, t };
    });
    const first = failing(meta), shown = await near(), text = () => page.textContent("#problem-text");
    if (first.part === "joint") assert.ok(Math.abs(shown.across - 0.5) < 0.4 && Math.abs(shown.up - 0.5) < 0.4, JSON.stringify(shown));
    assert.match(await text(), /^Problem/);
    const count = Number(/ of (\d+)/.exec(await text())?.[1] ?? 1), seen = [await text()];
    for (let k = 1; k < count; k++) {
      await page.keyboard.press("x");
      seen.push(await text());
      const now = await near();
      assert.ok(Math.abs(now.across - 0.5) < 0.5 && Math.abs(now.up - 0.5) < 0.5, `${seen.at(-1)}: ${JSON.stringify(now)}`);
    }
    assert.equal(new Set(seen).size, count);
    await page.keyboard.press("x");
    assert.equal(await text(), seen[0], "after the last the first");
    const joint = (await near()).joint;
    if (first.part === "joint") assert.equal(meta.joints[joint].name, first.worst);
  });
}

// The column `stability` is the engine's distance of the centre of mass inside the edge of the hull of all elements with load.
on("feasible: the support polygon is the engine's", pages.feasible, {}, async (page) => {
  const rows = await page.evaluate(() => {
    const { recording: r, stage: { view } } = window.gaitlab.page, out = [];
    for (let i = 40; i < r.rows; i += 31) {
      window.gaitlab.page.goTo(r.times[i]);
      out.push({ corners: view.support.polygon(r.times[i]), com: ["x", "y"].map((c) => r.channel(`com.${c}`)[i]), stability: r.channel("stability")[i] });
    }
    return out;
  });
  const off = rows.map(({ corners, com: [x, y], stability }) => {
    const turn = (a, b) => (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]), sides = corners.map((a, k) => [a, corners[(k + 1) % corners.length]]);
    const turns = sides.map(([a, b]) => turn(a, b)), inside = turns.every((v) => v > 0) || turns.every((v) => v < 0);
    const away = Math.min(...sides.map(([a, b]) => {
      const [u, v] = [b[0] - a[0], b[1] - a[1]], f = Math.min(Math.max(((x - a[0]) * u + (y - a[1]) * v) / (u * u + v * v), 0), 1);
      return Math.hypot(x - a[0] - f * u, y - a[1] - f * v);
    }));
    return Math.abs((inside ? away : -away) - stability);
  });
  // Quantum of the column: 0.5 mm. An element with less than 0.5 % of the weight belongs to the drawn polygon only.
  const close = off.filter((v) => v < 6e-4).length;
  assert.ok(close >= 0.9 * off.length, `${close} of ${off.length}: ${off.sort((a, b) => b - a).slice(0, 9)}`);
});

on("feasible: the arrow of travel points the way that the run went", pages.feasible, {}, async (page, meta) => {
  const { ways, went, ahead } = await page.evaluate(() => {
    const { recording: r, stage: { view } } = window.gaitlab.page, [x, y] = ["x", "y"].map((c) => r.channel(`com.${c}`)), last = r.rows - 1;
    window.gaitlab.page.goTo(4);
    const { position: p } = view.travel.arrow, row = r.row(4), way = view.travel.direction(4);
    return { ways: [2, 4, 6].map((t) => view.travel.direction(t).toArray()), went: [x[last] - x[0], y[last] - y[0]], ahead: Math.min(...view.robot.points().map((c) => (p.x - c.x) * way.x + (p.y - c.y) * way.y)), row };
  });
  const length = Math.hypot(...went);
  assert.ok(length > 0.2 * meta.summary.path_length && length > 0.1, String(length));
  for (const [x, y] of ways) assert.ok((x * went[0] + y * went[1]) / length > 0.9, `${x}, ${y}`);
  assert.ok(ahead > 0, "it begins before the robot");
});

on("feasible: arrows of forces begin where the forces act and have one scale, that of the legend", pages.feasible, {}, async (page, meta) => {
  const { arrows, scale, bar, words, perMetre } = await page.evaluate(() => {
    const { recording: r, stage: { view } } = window.gaitlab.page, { shafts: [shaft], tips: [tip], scale: length } = view.arrows, t = r.times[500];
    window.gaitlab.page.goTo(t);
    const at = (n, names) => names.map((c) => r.channel(`foot.${n}.${c}`)[500]), ends = (mesh, n) => [0, 1].map((y) => [0, 1, 2].map((k) => mesh.instanceMatrix.array[16 * n + 12 + k] + y * mesh.instanceMatrix.array[16 * n + 4 + k]));
    return { arrows: r.meta.feet.map((_, n) => ({ force: at(n, ["fx", "fy", "fz"]), point: at(n, ["x", "y", "z"]), start: ends(shaft, n)[0], end: ends(tip, n)[1] })), scale: length, bar: parseFloat(document.getElementById("force-bar").style.width), words: document.getElementById("force-words").textContent, perMetre: view.pixels(1) };
  });
  const loaded = arrows.filter(({ force }) => Math.hypot(...force) > 0.01 * meta.weight);
  assert.ok(loaded.length >= 3);
  for (const { force, point, start, end } of loaded) force.forEach((f, k) => {
    near(start[k], point[k], 1e-5, "start, m");
    near(end[k] - start[k], scale * f, 1e-5, "length, m");
  });
  near(bar, Number(/([\d.]+)\sN$/.exec(words)[1]) * scale * perMetre, 0.1, "bar, px");
});

on("feasible: bodies and docks have the colours of their loads", pages.feasible, {}, async (page, meta) => {
  for (const key of ["l", "k"]) await page.keyboard.press(key);
  const { shares, drawn, colours, docks, rings } = await page.evaluate(() => {
    const { page: desk, colours: { ringLoad } } = window.gaitlab, { recording: r, loads, stage: { view } } = desk, row = 500;
    desk.goTo(r.times[row]);
    const all = ["tension", "shear", "bending", "torsion"].map((kind) => r.meta.docks.map((_, n) => [...r.channel(`dock.${n}.${kind}`)]));
    return {
      shares: r.meta.joints.map((_, j) => loads.share(j)[row]), colours: Array.from({ length: 1001 }, (_, k) => ringLoad("light", k / 1000)),
      drawn: view.robot.kinds.flatMap(({ mesh, bodies }) => bodies.map((body, n) => ({ body, colour: [...mesh.instanceColor.array.slice(3 * n, 3 * n + 3)] }))),
      docks: r.meta.docks.map((_, n) => Math.max(0, ...all.map((one, k) => (k ? Math.abs(one[n][row]) : Math.max(one[n][row], 0)) / Math.max(...one.flat().map(Math.abs))))),
      rings: [...view.rings.fills.instanceColor.array],
    };
  });
  const linear = (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  const same = (found, share, what) => colours[Math.round(1000 * share)].forEach((c, k) => near(found[k], linear(c), 0.02, what));
  for (const { body, colour } of drawn) {
    const on = shares.filter((_, j) => meta.bodies.some((b, i) => b.joint === j && (i === body || b.parent === body)));
    same(colour, Math.max(0, ...on), meta.bodies[body].name);
  }
  docks.forEach((share, n) => same(rings.slice(3 * n), share, meta.docks[n].name));
});

on("fall: it is when it fell", pages.fall, { ...flat, link: "" }, async (page, meta) => {
  // The height of the start pose lowered onto the ground, of which check.value is the share at the lowest point.
  const check = failing(meta), { t } = await state(page), [before, at] = await page.evaluate(({ from, to, value }) => {
    const { recording } = window.gaitlab.page, z = recording.channel("com.z"), share = (time) => recording.at(z, time) / (recording.at(z, to) / value);
    return [share(from - 0.05), share(from + 0.02)];
  }, check);
  assert.equal(check.id, "fall");
  near(t, check.from, 1e-9, "time");
  assert.ok(before > check.limit && at < check.limit, `${before}, ${at} of the height at the start`);
});

on("pair_second: opens where the second run fails", pages.pair_second, { ...flat, link: "" }, async (page, meta) => {
  const check = failing(meta.overlay.run), { joint, t } = await state(page);
  assert.equal(failing(meta), undefined);
  assert.equal(meta.joints[joint].name, check.worst);
  assert.ok(t > check.from - meta.overlay.run.period && t < check.to + meta.overlay.run.period, `${t}, ${check.from} to ${check.to}`);
});

on("torque: the command of a torque source is drawn in N m", pages.torque, flat, async (page, meta) => {
  assert.equal(meta.motors[0].unit, "N m");
  assert.match(await page.textContent("#drive-key"), /torque asked for/);
  const drawn = await page.evaluate(() => {
    const { panels, state: now, recording } = window.gaitlab.page, { plot } = panels.flatMap((p) => p.plots ?? []).find((p) => p.plot.series[1].label === "torque asked for");
    return [Math.max(...plot.data[1].map(Math.abs)), Math.max(...recording.channel(`joint.${now.joint}.voltage_command`).map(Math.abs))];
  });
  assert.ok(drawn[0] > 0.01 && drawn[0] === drawn[1], String(drawn));
});

on("commands to paste have the folder of the page", pages.current, flat, async (page) => {
  const folder = pages.current.replace(/\/report.html$/, "");
  assert.ok((await page.textContent("#foot-text")).endsWith(`gaitlab rerun ${resolve(folder)}`));
  assert.equal(await page.textContent("#aside code"), `gaitlab report --demand ${resolve(folder)}`);
});

on("numbers below a floor are 0, and large ones have a prefix", Object.values(pages)[0], flat, async (page) => {
  const texts = await page.evaluate(() => {
    const { quantity, percent, decimalsOf, capital } = window.gaitlab.texts;
    return [quantity(3e-11, "N m"), percent(2.6e-10), quantity(1.17e6, "J"), quantity(-2.5e-9, "m"), quantity(0.0123, "m"), decimalsOf(1e-10, "N m"), decimalsOf(0.004, "N m"), capital("m3/active stalls"), capital("m5's dock is bent"), capital("the robot falls")];
  });
  assert.deepEqual(texts.map((t) => String(t).replaceAll("\u00a0", " ")), ["0 N m", "0 %", "1.17 MJ", "0 mm", "12.3 mm", "2", "4", "m3/active stalls", "m5's dock is bent", "The robot falls"]);
});

// Hinges are where the engine had them: the body that a hinge's frame belongs to, of the trace's body.* columns, through the camera's
// matrix. The page rounds positions to 0.02 mm, angles to 0.1 mrad, which adds up along the robot.
on("feasible: hinges are drawn where the engine had them", trace && pages.feasible, {}, async (page, meta) => {
  const columns = columnsOf(trace), times = columns.get("t");
  for (const row of [0, 137, 400, times.length - 1]) {
    const drawn = await page.evaluate((t) => {
      const { page: desk } = window.gaitlab, { view } = desk.stage, r = view.canvas.getBoundingClientRect();
      desk.goTo(t);
      return { matrix: view.projection, size: [r.width, r.height], at: desk.recording.meta.joints.map((_, j) => view.place(j)), world: view.kinematics.pivots.map((p) => p.toArray()) };
    }, times[row]);
    meta.joints.forEach(({ name }, j) => {
      const [module, hinge] = name.split("/"), body = `${module}/${hinge === "active" ? "link" : "passive"}`; // mtran.yaml: the hinges' children
      const p = ["x", "y", "z"].map((c) => columns.get(`body.${body}.${c}`)[row]), m = drawn.matrix;
      const [x, y, , w] = [0, 1, 2, 3].map((k) => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k]);
      near(Math.hypot(...p.map((v, k) => v - drawn.world[j][k])), 0, 3e-4, `${name} at ${times[row]} s, m`);
      near(drawn.at[j][0], (x / w + 1) / 2 * drawn.size[0], 1.5, `${name} at ${times[row]} s, px`);
      near(drawn.at[j][1], (1 - y / w) / 2 * drawn.size[1], 1.5, `${name} at ${times[row]} s, px`);
    });
  }
});

// Equations 1 and 2 with the constants of scenarios/modules/mtran.yaml: T = K i, i = (u - Ke w) / R, |u| <= 7.4 V, |i| <= 1.2 A.
on("feasible: the envelope is that of the motor", pages.feasible, flat, async (page, meta) => {
  const K = 0.7 * 0.00395 * 594, Ke = 0.00395 * 594, R = 4.3, clamp = (i) => Math.min(Math.max(i, -1.2), 1.2);
  const motor = meta.motors[meta.joints[0].motor], fastest = Math.max(...motor.speed);
  for (const w of [-0.9 * fastest, -2, -0.5, 0, 0.5, 1.5, 2.5, 0.9 * fastest]) {
    const [most, least, use] = await page.evaluate(([m, v]) => {
      const { motor: of } = window.gaitlab;
      return [of.most(m, v), of.least(m, v), of.use(m, v, 0.4)];
    }, [motor, w]);
    // Between samples a kink is cut: by less than a step of speed times the slope K Ke / R.
    const off = K * Ke / R * (motor.speed[1] - motor.speed[0]) / 4 + 1e-9, available = K * clamp((7.4 - Ke * w) / R);
    near(most, available, off, `most at ${w} rad/s`);
    near(least, K * clamp((-7.4 - Ke * w) / R), off, `least at ${w} rad/s`);
    near(use, available > 0 ? Math.min(0.4 / available, 1) : 1, available > 0.4 ? off / available : 0, `share at ${w} rad/s`);
  }
});

on("cured: what would make the gait feasible, and its map", pages.cured, flat, async (page) => {
  assert.equal(await page.textContent("#remedy-h"), "Changes that make it feasible");
  assert.deepEqual(await page.$$eval("#remedy li", (all) => all.map((l) => l.textContent)), ["Feasible with i_max ≥ 0.719 A", "Not by Kp <b>"]);
  assert.equal(await page.$$eval(".remedy-map rect.feasible", (all) => all.length), 36);
  assert.equal(await page.getAttribute(".remedy-map", "aria-label"), "Verdict over frequency and amplitude: 36 of 169 gaits are feasible");
  assert.equal(await page.textContent(".remedy-map rect:nth-of-type(15) title"), "0.0654 Hz, 0.262 times, feasible, 0.001 m/s, margin 10\u00a0%, current of <m1>");
  // The ring lies on the cell of factor 1, which is the middle one.
  const [ring, cell] = await page.evaluate(() => [".remedy-map circle", ".remedy-map rect:nth-of-type(85)"].map((s) => {
    const { x, y, width, height } = document.querySelector(s).getBoundingClientRect();
    return [x + width / 2, y + height / 2];
  }));
  near(Math.hypot(ring[0] - cell[0], ring[1] - cell[1]), 0, 1, "ring on its cell, px");
});

on("feasible: no remedy was searched", pages.feasible, flat, async (page) => assert.equal(await page.isVisible(".remedy"), false));

on("built: shows hinges, faces and axes, and no time", pages.built, {}, async (page, meta) => {
  assert.deepEqual(await page.$$eval("[data-gender]:not([hidden])", (all) => all.map((e) => e.textContent)), ["active face", "passive face"]);
  assert.deepEqual(await page.$$eval("#faces, #axes", (all) => all.map((b) => b.getAttribute("aria-pressed"))), ["true", "true"]);
  for (const id of ["#transport", "#checks", "#motion", "#heat", "#path"]) assert.equal(await page.isVisible(id), false, id);
  const rows = await page.$$eval("#parts tbody tr", (all) => all.map((r) => r.firstChild.textContent));
  assert.deepEqual(rows, [...meta.docks.map((d) => meta.modules[d.module].name), ...meta.joints.map((j) => j.name)]);
  assert.ok(await page.$$eval("#parts .scroll", (all) => all.every((e) => e.scrollHeight <= e.clientHeight + 1)), "no list is cut");
  // A dock that is clicked has a ring, which lies where the two faces meet.
  assert.equal(await page.isVisible("#legend-rings"), false);
  await page.click("#parts tbody tr:nth-child(2) button");
  assert.equal(await page.textContent("#ring-words"), `ring: ${meta.docks[1].name}'s dock`);
  assert.ok(await page.isVisible("#legend-rings"));
  const [chosen, off] = await page.evaluate(() => {
    const { stage: { view: { rings, robot } }, recording: { meta: { docks, bodies, faces } } } = window.gaitlab.page;
    return [rings.chosen, Math.max(...docks.map((d, n) => {
      const { body, local } = rings.places[n], ring = robot.matrix(body).clone().multiply(local).elements;
      const parent = bodies.findIndex((b) => b.module === d.parent && faces[b.type].some((f) => f.id === d.parent_face));
      const f = faces[bodies[parent].type].find((one) => one.id === d.parent_face).origin, e = robot.matrix(parent).elements;
      return Math.hypot(...[0, 1, 2].map((i) => e[i] * f[0] + e[4 + i] * f[1] + e[8 + i] * f[2] + e[12 + i] - ring[12 + i]));
    }))];
  });
  assert.equal(chosen, 1);
  near(off, 0, 1e-6, "a ring from the parent's face, m"); // poses are rounded to a micrometre
});

on("failed: why it ended, and what there is until then", pages.failed, flat, async (page, meta) => {
  assert.ok((await page.textContent("#why")).toLowerCase().startsWith(meta.outcome.toLowerCase()), meta.outcome);
  near(await page.evaluate(() => window.gaitlab.page.recording.end), meta.duration, meta.period, "the last row");
  assert.ok(await page.isVisible("#motion"));
});

on("old: what rows alone lack is said, and nothing is made up", pages.old, flat, async (page, meta) => {
  assert.ok(meta.missing.length > 0);
  assert.deepEqual(await page.$$eval("#missing li", (all) => all.map((l) => l.textContent.toLowerCase().replace(/[.]$/, ""))), meta.missing.map((m) => m.toLowerCase()));
  assert.ok(await page.isVisible("#motion"));
  assert.equal(await page.textContent("#why"), "Only the rows of the trace are left, which miss the peaks between them. Judge by gaitlab rerun FOLDER");
  for (const id of ["voltage", "fall", "dock_tension"]) assert.equal(await page.textContent(`[data-check="${id}"] .value`), "not judged");
});

on("csv: a run whose trace is text", pages.csv, flat, async (page, meta) => {
  assert.equal(meta.period, 0.02);
  assert.ok(await page.isVisible("#motion"));
  assert.ok(await page.isVisible("#heat canvas"));
});

for (const name of ["jointless", "built_ball"]) {
  on(`${name}: shows no joints`, pages[name], {}, async (page, meta) => {
    assert.equal(meta.joints.length, 0);
    for (const id of ["#motion", "#heat", "#envelope", "#phase"]) assert.equal(await page.isVisible(id), false, id);
    // The tag names the body of the check that the page opens at, if there is one.
    assert.equal(await page.isVisible("#tag") && await page.textContent("#tag"), name === "jointless" && meta.bodies[0].name);
    assert.ok(await page.isVisible("#view"));
    for (const key of ["[", "]", "j", "a"]) await page.keyboard.press(key);
    assert.equal((await state(page)).joint, -1);
  });
}

on("castor: what a joint without a motor does not have, the others do", pages.castor, {}, async (page, meta) => {
  assert.deepEqual(meta.joints.map((j) => j.motor === null), [true, false]);
  for (const id of ["#envelope canvas", "#heat canvas", "#power canvas"]) assert.ok(await page.isVisible(id), id);
  assert.match(await page.textContent("#heat-note"), /of the torque available/);
  assert.ok(await page.evaluate(() => window.gaitlab.page.loads.limited && Math.max(...window.gaitlab.page.loads.share(1)) > 0));
  assert.deepEqual(await page.$$eval("[data-gender]:not([hidden])", (all) => all.map((e) => e.textContent)), ["face without gender"]);
  await page.selectOption("#joint", "0");
});

for (const name of ["castor", "motorless", "jointless"]) {
  on(`${name}: nothing is undefined`, pages[name], flat, async (page) => {
    assert.doesNotMatch(await page.evaluate(() => [...document.querySelectorAll("body *:not(script, style)")].flatMap((e) => [...e.childNodes].filter((n) => n.nodeType === 3).map((n) => n.data)).join(" ")), /undefined|NaN/);
    for (const id of name === "castor" ? [] : ["#heat", "#heat-ramp", "#envelope", "#power"]) assert.ok(await page.isHidden(id), id);
  });
}

for (const name of ["pair", "robots", "ball"]) {
  on(`${name}: says what both runs found`, pages[name], flat, async (page, meta) => {
    const runs = [meta, meta.overlay.run];
    for (const [n, id] of ["#said", "#said-second"].entries()) assert.match(await page.textContent(id), saidOf(runs[n]));
    const rows = await page.$$eval("#checks [data-check]", (all) => all.map((r) => [r.dataset.check, ...[...r.querySelectorAll(".value")].map((v) => v.querySelector(".sr")?.textContent ?? null)]));
    const ids = new Set(runs.flatMap((r) => r.verdict.checks.map((c) => c.id)));
    assert.deepEqual(new Set(rows.map(([id]) => id)), ids);
    for (const [id, ...shown] of rows) assert.deepEqual(shown, runs.map((r) => wordOf(r.verdict.checks.find((c) => c.id === id)) ?? null), id);
    const told = await page.textContent("#pair"), own = meta.joints.map((j) => j.name), common = meta.overlay.run.joints.filter((j) => own.includes(j.name)).length;
    if (common < own.length) assert.match(told, common ? new RegExp(`have ${common} joints in common`) : /have no joint in common/);
  });

  on(`${name}: every joint, key and switch`, pages[name], {}, async (page, meta) => {
    for (let j = 0; j < meta.joints.length; j++) await page.keyboard.press("]");
    for (const key of ["End", "Home", "p", "ArrowRight", "z", "d", "p"]) await page.keyboard.press(key);
    for (const [id, values] of [["#what", ["torque", "current", "error"]], ["#side", ["own", "second", "difference"]]]) for (const value of values) await page.selectOption(id, value);
    await page.keyboard.press("Space");
    await frames(page, 10);
    assert.equal((await state(page)).playing, true);
  });
}

on("pair: runs of one scenario have the names of their folders", pages.pair, flat, async (page, meta) => {
  assert.equal(meta.name, meta.overlay.run.name);
  assert.deepEqual(meta.overlay.folders, ["brisk", "slow"]);
  assert.equal(await page.textContent("#name"), `${meta.name}: brisk and slow`);
  assert.equal(await page.title(), `${meta.name}: brisk and slow: gaitlab report`);
  const cards = await page.$$eval(".verdict .whose", (all) => all.map((one) => one.textContent));
  [["A", "brisk"], ["B", "slow"]].forEach(([label, folder], n) => assert.ok(cards[n].startsWith(`${label}${folder} ${meta.name}`), cards[n]));
  assert.match(await page.textContent("#foot-text"), /gaitlab rerun brisk$/, "the page has another name, and knows its folder");
  assert.doesNotMatch(await page.innerText("body"), /FOLDER/);
});

on("pair: the second run by the clock of the first", pages.pair, {}, async (page, meta) => {
  const found = await page.evaluate(() => {
    const { ghost, recording } = window.gaitlab.page, name = "joint.4.torque", own = ghost.recording.channel(name), laid = ghost.values(name);
    return { own: [...own], laid: [...laid], times: [...recording.times], end: ghost.recording.end };
  });
  assert.equal(meta.overlay.run.period, 0.02);
  found.times.forEach((t, i) => {
    // Rows of 5 ms and of 20 ms: at every fourth one the value, between them the straight line.
    const k = Math.floor(i / 4), f = (i % 4) / 4, expected = t > found.end + 1e-6 ? NaN : f === 0 ? found.own[k] : (1 - f) * found.own[k] + f * found.own[k + 1];
    if (Number.isNaN(expected)) assert.ok(Number.isNaN(found.laid[i]), `at ${t} s`);
    else near(found.laid[i], expected, 1e-5, `at ${t} s`); // 32 bits
  });
  const visible = async (t) => page.evaluate((x) => {
    window.gaitlab.page.goTo(x);
    return window.gaitlab.page.stage.view.second.robot.visible;
  }, t);
  assert.deepEqual([await visible(1), await visible(3.9)], [true, false], "it is gone when its run has ended");
});

on("pair: at the same phase", pages.pair, {}, async (page, meta) => {
  const { run } = meta.overlay;
  assert.ok(meta.cycle && run.cycle);
  await page.keyboard.press("p");
  assert.equal(await page.getAttribute("#align", "aria-pressed"), "true");
  const j = meta.phases.findIndex((p) => p.setpoint[0] > 0.2 * Math.max(...meta.phases.map((q) => q.setpoint[0])));
  const turns = (of, t) => t / of.cycle.period + of.phases[j].setpoint[1] / (2 * Math.PI);
  for (const t of [1, 2.2, 3]) {
    const [theirs, back] = await page.evaluate((x) => {
      const { ghost } = window.gaitlab.page;
      return [ghost.time(x), ghost.back(ghost.time(x))];
    }, t);
    const apart = turns(run, theirs) - turns(meta, t);
    near(apart, Math.round(apart), 1e-9, `turns apart at ${t} s`);
    near(back, t, 1e-9, "there and back");
  }
});

on("robots: a joint that one of them lacks", pages.robots, flat, async (page, meta) => {
  const theirs = meta.overlay.run.joints.map((j) => j.name), lone = meta.joints.findIndex((j) => !theirs.includes(j.name)), common = meta.joints.findIndex((j) => theirs.includes(j.name));
  await page.selectOption("#joint", String(lone));
  assert.match(await page.textContent("#motion-key"), /B has no such joint/);
  await page.selectOption("#joint", String(common));
  assert.match(await page.textContent("#motion-key"), /B: dashed/);
});

on("strayed: what left its band first, when, how far", pages.strayed, flat, async (page, meta) => {
  const { strays, strayed, labels } = meta.overlay, [first] = strays;
  assert.deepEqual(labels, ["golden", "now"]);
  assert.equal(await page.textContent("#said"), "The run left the bands of its golden");
  assert.equal(await page.textContent("#why"), `${strayed}.`);
  const { t, joint } = await state(page);
  near(t, first.from, 1e-9, "the first divergence is shown");
  assert.equal(joint, Number(first.signal.split(".")[1]));
  const rows = page.locator("#strays tbody tr");
  assert.equal(await rows.count(), strays.length);
  assert.ok(strays.every((s, i) => i === 0 || (s.from ?? Infinity) >= (strays[i - 1].from ?? Infinity)), "the first to stray first");
  const last = strays.findLastIndex((s) => s.signal.startsWith("joint.") && s.from !== null);
  await rows.nth(last).locator("button").click();
  near((await state(page)).t, strays[last].from, 1e-9, "a row goes to its time");
  // Where the difference is first beyond the tolerance, by the numbers that are drawn.
  const outside = await page.evaluate((s) => {
    const { ghost, recording } = window.gaitlab.page, row = ghost.difference(s.signal).findIndex((d) => Math.abs(d) > s.tolerance);
    return recording.times[row];
  }, strays[last]);
  near(outside, strays[last].from, meta.period + 1e-9, "first beyond the tolerance");
  assert.ok(await page.isVisible("#drift canvas"));
});

/** Clicks a button that saves a file, and returns the name and the bytes of the file. */
const saved = async (page, button) => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  return [download.suggestedFilename(), readFileSync(await download.path())];
};
/** Loads a video in an empty page; `frame` returns its picture at a time, 160 x 90 grey values. */
const video = async (page, bytes) => {
  const empty = await page.context().newPage();
  const facts = await empty.evaluate(async (base64) => {
    const of = Object.assign(document.createElement("video"), { src: `data:video/webm;base64,${base64}` });
    document.body.append(of);
    await new Promise((done, failed) => Object.assign(of, { onloadeddata: done, onerror: () => failed(new Error(of.error.message)) }));
    return [of.duration, of.videoWidth, of.videoHeight];
  }, bytes.toString("base64"));
  const frame = (t) => empty.evaluate(async (at) => {
    const of = document.querySelector("video"), on = new OffscreenCanvas(160, 90).getContext("2d");
    await new Promise((done) => Object.assign(of, { onseeked: done, currentTime: at }));
    on.drawImage(of, 0, 0, 160, 90);
    return [...on.getImageData(0, 0, 160, 90).data].filter((_, k) => k % 4 === 1);
  }, t);
  return { facts, frame };
};

on("feasible: the film has the run's motion at the speed chosen", pages.feasible, {}, async (page, meta) => {
  await page.evaluate(() => window.gaitlab.page.zoom([1, 3]));
  await page.selectOption("#speed", "4");
  const before = await state(page);
  const [name, bytes] = await saved(page, "#film");
  assert.equal(name, `${meta.name}.webm`);
  await page.waitForFunction(() => document.getElementById("film").textContent === "Film");
  assert.deepEqual(await state(page), before);
  const { facts, frame } = await video(page, bytes);
  assert.deepEqual(facts, [0.5, 1280, 720]);
  // Of the pictures at the times of all frames, that of its own time is nearest to a frame.
  const pictures = await page.evaluate(() => Array.from({ length: 15 }, (_, k) => {
    const on = new OffscreenCanvas(160, 90).getContext("2d");
    on.drawImage(window.gaitlab.page.stage.view.picture(1 + (4 * k) / 30, 1280, 720), 0, 0, 160, 90);
    return [...on.getImageData(0, 0, 160, 90).data].filter((_, i) => i % 4 === 1);
  }));
  const apart = (a, b) => a.reduce((sum, x, i) => sum + Math.abs(x - b[i]), 0);
  for (const k of [0, 4, 9, 14]) {
    const seen = await frame((k + 0.5) / 30), off = pictures.map((one) => apart(one, seen));
    assert.equal(off.indexOf(Math.min(...off)), k, `frame ${k}: ${off}`);
  }
});

on("infeasible: the picture of a message; a film that is stopped leaves no file", pages.infeasible, { link: "t=2" }, async (page, meta) => {
  const [name, bytes] = await saved(page, "#card");
  assert.equal(name, `${meta.name}.png`);
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [1200, 630]);
  let files = 0;
  page.on("download", () => files++);
  await page.click("#film");
  await page.waitForFunction(() => document.getElementById("film").textContent.startsWith("Stop"));
  await page.click("#film");
  await page.waitForFunction(() => document.getElementById("film").textContent === "Film");
  assert.equal(files, 0);
  assert.equal((await state(page)).t, 2);
  // An encoder that fails: the page says why.
  await page.evaluate(() => { VideoEncoder.prototype.encode = () => { throw new Error("no memory"); }; });
  await page.click("#film");
  await page.waitForSelector("#unsaved:visible");
  assert.equal(await page.textContent("#unsaved"), "The .webm file could not be made: no memory.");
  assert.ok(await page.isHidden(".still"));
});

on("current: with more than ten feet, a foot stands above a share of the mean load", pages.current, flat, async (page, meta) => {
  assert.ok(meta.feet.length > 10, String(meta.feet.length));
  assert.match(await page.textContent("#foot-note"), /above a fifth of the mean load/);
});

if (pages.open) {
  // docs/site/gallery.py writes this attribute.
  const folder = mkdtempSync(join(tmpdir(), "gallery-")), copy = join(folder, "open.html");
  writeFileSync(copy, readFileSync(pages.open, "utf8").replace('<html lang="en"', '<html lang="en" data-folder="runs/here"'));
  after(() => rmSync(folder, { recursive: true }));
  on("gallery: commands name the folder that the page states", copy, flat, async (page) => {
    assert.match(await page.textContent("#foot-text"), /gaitlab rerun runs\/here/);
  });
}

on("feasible: with ten feet or fewer, it stands above a share of the weight", pages.feasible, flat, async (page, meta) => {
  assert.ok(meta.feet.length <= 10, String(meta.feet.length));
  assert.match(await page.textContent("#foot-note"), /above 2 % of the weight/);
});

// The bytes that report/page/page_data.cpp writes for these values, by hand from the rule: differences, zigzag, LEB128.
// 0 1 -1 64 -64 8191 -8192 1000000: differences 0 1 -2 65 -128 8255 -16383 1008192, zigzag 0 2 3 130 255 16510 32765 2016384.
on("unpacks the bytes that C++ packs", Object.values(pages)[0], flat, async (page) => {
  const bytes = [0x00, 0x02, 0x03, 0x82, 0x01, 0xff, 0x01, 0xfe, 0x80, 0x01, 0xfd, 0xff, 0x01, 0x80, 0x89, 0x7b];
  const unpacked = (channels, list) => page.evaluate(([c, b]) => [...window.gaitlab.unpack(c, Uint8Array.from(b))].map(([name, values]) => [name, [...values]]), [channels, list]);
  assert.deepEqual(await unpacked([["a", "m", 1, 8]], bytes), [["a", [0, 1, -1, 64, -64, 8191, -8192, 1000000]]]);
  assert.deepEqual(await unpacked([["a", "m", 1, 3], ["b", "", 0.5, 1]], [0, 2, 3, 2]), [["a", [0, 1, -1]], ["b", [0.5]]]);
  await assert.rejects(unpacked([["a", "m", 1, 8]], bytes.slice(0, -1)), /end within channel a/);
  await assert.rejects(unpacked([["a", "m", 1, 7]], bytes), /3 bytes too many/);
});
