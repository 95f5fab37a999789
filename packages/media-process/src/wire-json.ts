/** What a media process says in JSON, checked. */
import * as z from 'zod';
import { WireError } from './wire-error.ts';

/** @throws {WireError} `bad-message` */
export function parseWireJson<T>(schema: z.ZodType<T>, payload: Uint8Array, what: string): T {
  try {
    return schema.parse(JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(payload)));
  } catch (cause) {
    throw new WireError('bad-message', `${what} that is not valid`, { cause });
  }
}

const logSchema = z.object({ level: z.enum(['debug', 'warn', 'error']), msg: z.string() });
export type LogLine = z.infer<typeof logSchema>;

/** A line of the standard error. Plugins write there, too, as they like. */
export function parseLogLine(line: string): LogLine {
  try {
    const result = logSchema.safeParse(JSON.parse(line));
    if (result.success) return result.data;
  } catch {
    // Not JSON.
  }
  return { level: 'warn', msg: line };
}
