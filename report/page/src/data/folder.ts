// Folder of a run, for the commands that the page shows. The folder follows from the address of the page, because the
// file of the page does not contain the name of its folder.

/** Folder of the page, quoted for a shell; the word FOLDER if the page was renamed or is not a local file. */
export function folder(): string {
  const [, path] = /^(.*)\/(?:report|compare)\.html$/.exec(decodeURIComponent(location.pathname)) ?? [];
  if (location.protocol !== "file:" || !path) return "FOLDER";
  return word(path);
}

/** Word of a command, quoted for a shell if necessary. */
export const word = (text: string): string => (/^[\w./+=-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
