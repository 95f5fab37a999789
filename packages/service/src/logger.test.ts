import { expect, test } from 'vitest';
import { formatLogLine } from './log-format.ts';
import { createLogger } from './logger.ts';

function collect(isTTY: boolean): { lines: string[]; stream: { isTTY: boolean; write(line: string): void } } {
  const lines: string[] = [];
  return { lines, stream: { isTTY, write: (line) => void lines.push(line) } };
}

test('JSON if it is not a terminal, with level names and ISO time', () => {
  const { lines, stream } = collect(false);
  const log = createLogger({ name: 'robot', level: 'info', format: 'auto', stream });
  log.debug('unseen');
  log.info({ robot: 'r1' }, 'joined');
  expect(lines).toHaveLength(1);
  expect(JSON.parse(lines[0]!)).toEqual({
    level: 'info',
    time: expect.stringMatching(/^\d{4}-\d\d-\d\dT[\d:.]+Z$/),
    name: 'robot',
    robot: 'r1',
    msg: 'joined',
  });
});

test('readable on a terminal, with the stack of an error', () => {
  const { lines, stream } = collect(true);
  const log = createLogger({ name: 'robot', level: 'info', format: 'auto', stream });
  log.error({ err: new Error('no link'), attempt: 3, to: 'x y' }, 'failed');
  expect(lines[0]).toContain('robot: failed');
  expect(lines[0]).toContain('attempt=3 to=x y');
  expect(lines[0]).toContain('Error: no link\n    at ');
});

test('shows an error’s cause separately, once; a remedy follows an arrow', () => {
  const { lines, stream } = collect(false);
  const log = createLogger({ name: 'robot', level: 'info', format: 'auto', stream });
  log.error({ err: new Error('no camera', { cause: new Error('no file') }), remedy: 'plug it in' }, 'failed');
  const { err } = JSON.parse(lines[0]!) as { err: { message: string; cause: { message: string } } };
  expect(err.message).toBe('no camera');
  expect(err.cause.message).toBe('no file');
  const text = formatLogLine(lines[0]!, false);
  expect(text).toContain('robot: failed → plug it in\nError: no camera');
  expect(text).toContain('\ncaused by: Error: no file');
});

test('format takes precedence over the kind of stream', () => {
  const terminal = collect(true);
  createLogger({ name: 'a', level: 'info', format: 'json', stream: terminal.stream }).info('x');
  expect(() => JSON.parse(terminal.lines[0]!)).not.toThrow();
  const file = collect(false);
  createLogger({ name: 'a', level: 'info', format: 'text', stream: file.stream }).info('x');
  expect(file.lines[0]).toMatch(/^\d\d:\d\d:\d\d\.\d{3} info {2}a: x\n$/);
});

test('a line that is not a log record passes unchanged', () => {
  expect(formatLogLine('plain\n', false)).toBe('plain\n');
});
