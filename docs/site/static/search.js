// The search: finds the words of ?q= in the sections of all pages (search_texts.js), and lists pages with an excerpt.
"use strict";

const empty = new Set("a an and are as at be by can do does for from how i in is it my no not of on or that the to what when which why with".split(" "));

/** Words of a query in lower case, without those that every page has; a plural also finds its singular. */
function wordsOf(query) {
  const all = [...new Set(query.toLowerCase().match(/[\p{L}\d_./%+-]+/gu) ?? [])].map((w) => w.replace(/[./-]+$/, "")).filter(Boolean);
  const words = all.filter((w) => !empty.has(w));
  return (words.length ? words : all).map((w) => (w.length > 3 ? w.replace(/s$/, "") : w));
}
/** A word where a text has it from its beginning; the words within an option (--fail-infeasible) are no words of the text. */
const expressionOf = (word) => new RegExp(`(?<![\\p{L}\\d]|--[\\w-]*)${word.replace(/[.*+?^${}()|[\]\\/]/g, "\\$&")}`, "giu");

/** The worth of a word in a text: begins a word of it; more often is worth more, but less and less. */
const worth = (expression, text, weight) => {
  const count = (text.match(expression) ?? []).length;
  return count ? weight * (1 + Math.log(count)) : 0;
};

/** A section's score; 0 if a word is neither in it nor in the title of its page. */
function scoreOf(page, [, heading, text, terms], expressions, index) {
  let sum = 0;
  for (const e of expressions) {
    const score = worth(e, heading, 12) / Math.sqrt((heading.match(/[\p{L}\d]+/gu) ?? [""]).length) + worth(e, page.title, index ? 4 : 8) + worth(e, terms, 4) + worth(e, text, 2) / Math.sqrt(1 + text.length / 2000);
    if (!score) return 0;
    sum += score;
  }
  return sum;
}

function find(query) {
  const expressions = wordsOf(query).map(expressionOf);
  if (!expressions.length) return [];
  const found = searchTexts.map((page) => {
    const scores = page.sections.map((section, i) => scoreOf(page, section, expressions, i));
    const best = scores.indexOf(Math.max(...scores));
    return { page, section: page.sections[best], score: (page.worth || 1) * (scores[best] + 0.1 * scores.reduce((a, b) => a + b, 0)) };
  });
  return found.filter((f) => f.score > 0).sort((a, b) => !a.page.worth - !b.page.worth || b.score - a.score);
}

/** About 200 characters of a text, from a little before the hit after which the most words follow. */
function excerptOf(text, expressions) {
  const hits = expressions.flatMap((e, word) => [...text.matchAll(e)].map((hit) => ({ at: hit.index, word }))).sort((a, b) => a.at - b.at);
  const kinds = hits.map(({ at }, i) => new Set(hits.slice(i, i + 20).filter((h) => h.at < at + 140).map((h) => h.word)).size);
  const first = hits[kinds.indexOf(Math.max(...kinds))]?.at ?? 0;
  const start = first > 60 ? text.indexOf(" ", first - 60) + 1 : 0;
  const end = text.length - start > 200 ? text.lastIndexOf(" ", start + 200) : text.length;
  return `${start ? "… " : ""}${text.slice(start, Math.max(end, start + 1))}${end < text.length ? " …" : ""}`;
}

/** Appends a text to an element, its hits in <mark>. */
function appendMarked(element, text, expressions) {
  const every = new RegExp(expressions.map((e) => e.source).join("|"), "giu");
  let end = 0;
  for (const hit of text.matchAll(every)) {
    const mark = document.createElement("mark");
    mark.textContent = hit[0];
    element.append(text.slice(end, hit.index), mark);
    end = hit.index + hit[0].length;
  }
  element.append(text.slice(end));
}

function itemOf({ page, section: [anchor, heading, text] }, expressions, query) {
  const item = document.createElement("li"), link = document.createElement("a"), group = document.createElement("span"), excerpt = document.createElement("p");
  link.href = `${page.page}?highlight=${encodeURIComponent(query)}${heading === page.title ? "" : `#${anchor}`}`;
  link.textContent = heading === page.title ? heading : `${page.title}: ${heading}`;
  group.textContent = page.group;
  group.className = "group";
  appendMarked(excerpt, excerptOf(text || page.sections.find((s) => s[2])?.[2] || "", expressions), expressions);
  item.append(link, " ", group, excerpt);
  return item;
}

const query = new URLSearchParams(location.search).get("q") ?? "";
for (const input of document.querySelectorAll('input[name="q"]')) input.value = query;
if (query.trim()) {
  const found = find(query), expressions = wordsOf(query).map(expressionOf);
  document.getElementById("search-count").textContent = found.length ? `${found.length} pages with “${query}”` : `No page has all of “${query}”: try fewer words.`;
  document.getElementById("search-results").append(...found.slice(0, 50).map((f) => itemOf(f, expressions, query)));
}
