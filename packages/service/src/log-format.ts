const COLOURS: Readonly<Record<string, string>> = {
  trace: '90',
  debug: '90',
  info: '36',
  warn: '33',
  error: '31',
  fatal: '31;1',
};

/** Formats one line of JSON log for people: `12:30:01.250 info  signaling: robot joined  robot=r1`. */
export function formatLogLine(line: string, colour: boolean): string {
  let record: Record<string, unknown>;
  try {
    record = JSON.parse(line) as Record<string, unknown>;
  } catch {
    return line;
  }
  const { level, time, name, msg, err, remedy, ...rest } = record;
  const paint = (code: string, text: string): string => (colour ? `\u001b[${code}m${text}\u001b[0m` : text);
  const levelName = String(level);
  const clock = typeof time === 'string' ? time.slice(11, 23) : '';
  const fields = Object.entries(rest).map(
    ([key, value]) => `${key}=${typeof value === 'string' ? value : JSON.stringify(value)}`,
  );
  const cure = typeof remedy === 'string' ? ` → ${remedy}` : '';
  const head = `${paint('90', clock)} ${paint(COLOURS[levelName] ?? '0', levelName.padEnd(5))} ${String(name)}: ${String(msg ?? '')}${cure}`;
  const tail = fields.length === 0 ? '' : `  ${paint('90', fields.join(' '))}`;
  const error = isErrorRecord(err) ? `\n${errorText(err)}` : '';
  return `${head}${tail}${error}\n`;
}

interface ErrorRecord {
  stack?: string;
  message?: string;
  cause?: unknown;
}

function errorText({ stack, message, cause }: ErrorRecord): string {
  return `${stack ?? message ?? ''}${isErrorRecord(cause) ? `\ncaused by: ${errorText(cause)}` : ''}`;
}

function isErrorRecord(value: unknown): value is ErrorRecord {
  return typeof value === 'object' && value !== null;
}
