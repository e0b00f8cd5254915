// Folder of a run, for commands to paste. It follows from the address of the page, because the file does not contain
// the name of its folder.

/** Folder, quoted for a shell; FOLDER if the page was renamed or is not a local file. */
export function folder(): string {
  const [, path] = /^(.*)\/(?:report|compare)\.html$/.exec(decodeURIComponent(location.pathname)) ?? [];
  if (location.protocol !== "file:" || !path) return "FOLDER";
  return /^[\w./+-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`;
}
