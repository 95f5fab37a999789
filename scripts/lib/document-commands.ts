/** Finds the commands in the documents that people copy into a shell. */

export interface DocumentCommand {
  /** As written, without its comment, and with one space for several or for a line continuation. */
  text: string;
  /** Counts from 1. */
  line: number;
}

/** An inline code span in prose is a command if it begins like this and continues. */
const INLINE =
  /^(npx -y pnpm@12|pnpm|node|sudo|docker|systemctl|journalctl|curl|python3|cargo|apt-get|farpoint-\w+) \S/;
const FENCE = /^\s*```(\w*)\s*$/;
const SHELL = new Set(['sh', 'bash', 'shell', 'console']);
const HERE_DOCUMENT = /<<'?(\w+)'?/;

/** Commands in fenced shell blocks, and those that prose names between backticks. */
export function documentCommands(markdown: string): DocumentCommand[] {
  const found: DocumentCommand[] = [];
  /** Language of the block that contains the line. */
  let block: string | null = null;
  let begun: DocumentCommand | null = null;
  let hereEnd: string | null = null;
  markdown.split('\n').forEach((raw, index) => {
    const line = index + 1;
    const fence = FENCE.exec(raw);
    if (fence !== null) {
      block = block === null ? (fence[1] ?? '') : null;
      begun = null;
      hereEnd = null;
    } else if (block === null) {
      for (const [, code = ''] of raw.matchAll(/`([^`]+)`/g))
        if (INLINE.test(code)) found.push({ text: squeeze(code), line });
    } else if (SHELL.has(block)) {
      if (hereEnd !== null) {
        if (raw.trim() === hereEnd) hereEnd = null;
        return;
      }
      const goesOn = raw.endsWith('\\');
      const text = squeeze(withoutComment(goesOn ? raw.slice(0, -1) : raw));
      if (begun !== null) begun.text = squeeze(`${begun.text} ${text}`);
      else if (text !== '') {
        begun = { text, line };
        found.push(begun);
      }
      hereEnd = HERE_DOCUMENT.exec(text)?.[1] ?? null;
      if (!goesOn) begun = null;
    }
  });
  return found;
}

/** Splits a command into words as a shell does. Of the shell's other features, it supports only quotes. */
export function shellWords(command: string): string[] {
  return [...command.matchAll(/"([^"]*)"|'([^']*)'|(\S+)/g)].map(
    ([, double, single, plain]) => double ?? single ?? plain ?? '',
  );
}

function withoutComment(line: string): string {
  return line.replace(/(^|\s)#\s.*$/, '');
}

function squeeze(text: string): string {
  return text.trim().replaceAll(/\s+/g, ' ');
}
