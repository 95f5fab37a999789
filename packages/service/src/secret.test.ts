import { format, inspect } from 'node:util';
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { createLogger } from './logger.ts';
import * as schema from './option-schemas.ts';
import { Secret, withoutCredentials } from './secret.ts';
import { anyAddress } from './testing/any-address.ts';

it('a secret is shown by nothing but its own word', () => {
  const secret = new Secret('hunter2');
  const held = { options: { token: secret, list: [secret] } };
  const shown = [
    ...[String(secret), `${secret}`, JSON.stringify(held), inspect(held, { depth: 9, showHidden: true })],
    ...[
      format('%s %o %j', secret, held, held),
      new Error(`no ${secret}`).message,
      Object.entries(held).join(),
    ],
  ];
  for (const each of shown) expect(each).not.toContain('hunter2');
  expect(String(secret)).toBe('[secret]');
  expect(secret.reveal()).toBe('hunter2');
});

it('an option’s value becomes a secret, and is checked before', () => {
  const option = schema.secret(schema.text({ max: 8 }));
  expect(option.parse('hunter2').reveal()).toBe('hunter2');
  const { error } = option.safeParse('hunter2hunter2');
  expect(error?.issues[0]?.message).toBe('must be 1–8 characters long');
});

it.each([
  ['ws://robot:hunter2@10.0.0.5:3000/robot', 'ws://…@10.0.0.5:3000/robot'],
  ['cannot open rtsp://me:hun@ter2@cam/a, twice', 'cannot open rtsp://…@cam/a, twice'],
  ['{"url":"wss://u:hunter2@h/"}', '{"url":"wss://…@h/"}'],
  ['ws://h:3001/?token=hunter2&x=1', 'ws://h:3001/?token=…&x=1'],
  ['https://h/?access_token=hunter2#a', 'https://h/?access_token=…#a'],
  ['https://h/a@b?mail=a@b', 'https://h/a@b?mail=a@b'],
  ['mail ada@example.org', 'mail ada@example.org'],
])('%s is shown as %s', (text, shown) => {
  expect(withoutCredentials(text)).toBe(shown);
});

it('no line of a log has the password of an address, whatever the address and wherever it is', () => {
  const lines: string[] = [];
  for (const format of ['json', 'text'] as const) {
    const stream = { isTTY: false, write: (line: string) => void lines.push(line) };
    const log = createLogger({ name: 'robot', level: 'info', format, stream });
    fc.assert(
      fc.property(anyAddress, (address) => {
        const url = new URL(address);
        [url.username, url.password] = ['ada', 'hunter2/?#@'];
        log.info({ url: url.href, facts: { at: [url.href] } }, `lost ${url.href}`);
        log.error({ err: new Error(`no ${url.href}`, { cause: new Error(url.href) }) }, 'failed');
      }),
      { numRuns: 50 },
    );
  }
  expect(lines.length).toBe(200);
  for (const line of lines) expect(line).not.toMatch(/hunter2|ada:/);
});
