/** Offers a table to the person as a file. */

/** @param name of what it has, in its file's name */
export function saveText(name: string, text: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'text/csv' }));
  link.download = fileName(name, new Date());
  link.click();
  URL.revokeObjectURL(link.href);
}

/** @returns for example `farpoint-clouds-2026-11-30T11-12-05.csv`, which each file system takes */
function fileName(name: string, at: Date): string {
  return `farpoint-${name}-${at.toISOString().slice(0, 19).replaceAll(':', '-')}.csv`;
}
