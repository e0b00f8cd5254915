// The folder of a run, for commands to paste: that of this page, where it still lies there. No page holds its folder's name.

/** As a shell takes it; FOLDER where the page is not at the place of a run's page, so that nobody knows. */
export function folder(): string {
  const [, path] = /^(.*)\/(?:report|compare)\.html$/.exec(decodeURIComponent(location.pathname)) ?? [];
  if (location.protocol !== "file:" || !path) return "FOLDER";
  return /^[\w./+-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`;
}
