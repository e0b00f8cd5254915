// Sets the equations of a page by KaTeX.
"use strict";

for (const element of document.querySelectorAll("article .math"))
  katex.render(element.textContent, element, { displayMode: element.tagName === "DIV", throwOnError: false });
