// Folder of a run, for the commands that the page shows. The folder follows from the address of the page, because the
// file of the page does not contain the name of its folder.

/** Folder of the page, quoted for a shell; the word FOLDER if the page was renamed or is not a local file. */
export function folder(): string {
  const [, path] = /^(.*)\/(?:report|compare)\.html$/.exec(decodeURIComponent(location.pathname)) ?? [];
  if (location.protocol !== "file:" || !path) return "FOLDER";
  return /^[\w./+-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`;
}
