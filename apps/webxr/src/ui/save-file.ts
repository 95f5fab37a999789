/** Offers a file for saving, named by what it is and by the time now. */

/** @param kind what it is, e.g. `latency` @param extension without a dot */
export function saveFile(kind: string, extension: string, content: Blob): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  const time = new Date().toISOString().slice(0, 19).replaceAll(':', '-');
  link.download = `farpoint-${kind}-${time}.${extension}`;
  link.click();
  URL.revokeObjectURL(link.href);
}
