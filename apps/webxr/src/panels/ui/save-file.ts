/** Offers a file to the person. */

/** How long a browser may take to begin reading what it saves, ms. Chosen: it begins at once; a busy one has taken seconds. */
const READ_WITHIN_MS = 60_000;

/** @param name of what it holds, in its file's name */
export function saveFile(name: string, extension: string, content: Blob): void {
  const link = document.createElement('a');
  const address = URL.createObjectURL(content);
  link.href = address;
  link.download = fileName(name, extension, new Date());
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), READ_WITHIN_MS);
}

/** Saves a table of comma-separated values. */
export function saveTable(name: string, text: string): void {
  saveFile(name, 'csv', new Blob([text], { type: 'text/csv' }));
}

/** @returns for example `farpoint-clouds-2026-11-30T11-12-05.csv`, which each file system takes */
function fileName(name: string, extension: string, at: Date): string {
  return `farpoint-${name}-${at.toISOString().slice(0, 19).replaceAll(':', '-')}.${extension}`;
}
