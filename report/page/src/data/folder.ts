// Folder of a run, for the commands that the page shows. The folder follows from the address of the page, because the
// file of the page does not contain the name of its folder.
import type { Meta } from "./format";

/**
 * Folder of the page, quoted for a shell. If the page was renamed or is not a local file, it is the name of the folder,
 * or the word FOLDER if the page does not know it. A page of the gallery has the folder into which its scenario runs.
 */
export function folder({ overlay }: Meta): string {
  const { folder: known } = document.documentElement.dataset;
  if (known) return word(known);
  const [, path] = /^(.*)\/(?:report|compare)\.html$/.exec(decodeURIComponent(location.pathname)) ?? [];
  if (location.protocol !== "file:" || !path) return word(overlay?.folders[0] ?? "") || "FOLDER";
  return word(path);
}

/** Word of a command, quoted for a shell if necessary. */
export const word = (text: string): string => (/^[\w./+=-]*$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
