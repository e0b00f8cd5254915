// A page in Debian's Chromium, as a reader opens it: no network, no GPU.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { inflateSync } from "node:zlib";

/** The modules of report/page/package-lock.json, which the gate has installed (tests/node.sh). */
export const modules = createRequire(join(resolve(process.env.NODE_MODULES), "of.mjs"));
const { chromium } = modules("playwright-core");

// Every wait is for a state, and this, in ms, only ends what would wait for ever: a machine may be slow.
const patience = 1_200_000;
const options = { timeout: patience, executablePath: process.env.CHROMIUM, args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader"] };
const launched = {};
/** The browser with or without WebGL, started when it is first needed. */
const browser = (webgl) => launched[webgl] ??= chromium.launch(webgl ? options : { ...options, args: [...options.args, "--disable-3d-apis"] });
export const close = async () => { for (const one of Object.values(launched)) await (await one).close(); };

/** A page that is ready (it has the element `ready`), from a file or, with `site`, from that server on this machine, in a browser with or without
 * WebGL; `complaints`: errors on the console, exceptions, requests. */
export async function open(file, { link = "paused", ready = "html[data-ready]", width = 1440, height = 900, webgl = true, site = "", ...more } = {}) {
  const context = await (await browser(webgl)).newContext({ viewport: { width, height }, offline: !site, bypassCSP: false, ...more });
  context.setDefaultTimeout(patience);
  const page = await context.newPage(), complaints = [];
  page.on("console", (m) => { if (m.type() === "error") complaints.push(m.text()); });
  const broken = new Promise((_, reject) => page.on("pageerror", (e) => {
    complaints.push(String(e.stack));
    reject(e);
  }));
  broken.catch(() => {}); // once the page is ready, it is a complaint
  page.on("request", (r) => { if (!/^(file|data|blob):/.test(r.url()) && !(site && r.url().startsWith(site))) complaints.push(`a request: ${r.url()}`); });
  await page.goto(site ? `${site}/${file}#${link}` : `file://${resolve(file)}#${link}`);
  await Promise.race([page.waitForSelector(ready), broken]);
  return { page, complaints, close: () => context.close() };
}

/** Waits until the page has drawn so many frames; what observes a size draws in the frame after the change. */
export const frames = (page, n) => page.evaluate((left) => new Promise((done) => {
  const frame = () => (left-- > 0 ? requestAnimationFrame(frame) : done());
  frame();
}), n);

/** What the program put into a page. */
export function metaOf(file) {
  const found = /<script type="application\/json" id="meta">([^]*?)<\/script>/.exec(readFileSync(file, "utf8"));
  if (!found) throw new Error(`${file} has no meta`);
  return JSON.parse(found[1]);
}

/** A CSV file as columns of numbers by name. */
export function columnsOf(file) {
  const [head, ...rows] = readFileSync(file, "utf8").trim().split("\n").map((line) => line.split(","));
  return new Map(head.map((name, i) => [name.replaceAll('"', ""), rows.map((r) => Number(r[i]))]));
}

/** Text of each page of a PDF that Chromium has printed, without blanks: glyphs by the tables of their fonts. */
export function pageTexts(pdf) {
  const objects = new Map([...pdf.toString("latin1").matchAll(/(?:^|\n)(\d+) 0 obj\n([^]*?)\nendobj/g)].map(([, n, body]) => [n, body]));
  const stream = (n) => {
    const body = objects.get(n), from = body.indexOf("stream\n") + 7, data = Buffer.from(body.slice(from, body.lastIndexOf("\nendstream")), "latin1");
    return (/FlateDecode/.test(body.slice(0, from)) ? inflateSync(data) : data).toString("latin1");
  };
  const hex = (digits, size = 4) => digits.match(new RegExp(`.{${size}}`, "g")).map((d) => parseInt(d, 16));
  const glyphs = (font) => {
    const map = new Map(), table = /\/ToUnicode (\d+)/.exec(objects.get(font));
    for (const [, kind, list] of table ? stream(table[1]).matchAll(/beginbf(char|range)([^]*?)endbf/g) : []) {
      for (const [, from, to, code] of list.matchAll(kind === "char" ? /<(\w+)>( )<(\w+)>/g : /<(\w+)> <(\w+)> <(\w+)>/g)) {
        map.digits = from.length;
        for (let g = parseInt(from, 16), k = 0; k === 0 || g + k <= parseInt(to, 16); k++) map.set(g + k, String.fromCharCode(...hex(code).map((c) => c + k)));
      }
    }
    return map;
  };
  const bytes = (literal) => literal.replace(/\\(\d{3}|.)/g, (_, c) => (c.length > 1 ? String.fromCharCode(parseInt(c, 8)) : { n: "\n", r: "\r", t: "\t", b: "\b", f: "\f" }[c] ?? c));
  return [...objects.values()].filter((one) => /\/Type \/Page\b/.test(one)).map((page) => {
    const fonts = new Map([...page.matchAll(/\/(F\d+) (\d+) 0 R/g)].map(([, name, n]) => [name, glyphs(n)]));
    let font, text = "";
    for (const [, name, digits, literal] of stream(/\/Contents (\d+)/.exec(page)[1]).matchAll(/\/(F\d+) [\d.]+ Tf|<(\w+)>|\(((?:\\[^]|[^\\)])*)\)/g)) {
      if (name) font = fonts.get(name);
      else for (const g of hex(digits ?? Buffer.from(bytes(literal), "latin1").toString("hex"), font?.digits)) text += font?.get(g) ?? "";
    }
    return text.normalize("NFKC").replace(/\s/g, "");
  });
}
