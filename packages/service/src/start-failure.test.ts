import { expect, test } from 'vitest';
import * as schema from './option-schemas.ts';
import { defineOption, defineProgram } from './option-table.ts';
import { adminOptions } from './program.ts';
import { StartFailure, startFailureOf } from './start-failure.ts';

const definition = defineProgram({
  ...{ name: 'farpoint-robot', summary: '', version: '0.0.0', section: 'robot' },
  options: {
    ...adminOptions(9400),
    port: defineOption({ schema: schema.port(), default: 3000, argument: 'PORT', help: '' }),
    path: defineOption({ schema: schema.optional(schema.text()), default: null, argument: 'PATH', help: '' }),
  },
});
const values = { adminHost: '10.9.9.9', adminPort: 9400, port: 3000, path: '/data/a.mcap' };

function of(fields: object, cause = true) {
  const system = Object.assign(new Error('listen EADDRINUSE'), fields);
  const error = cause ? new Error('the robot says more', { cause: system }) : system;
  const failure = startFailureOf(error, definition, values, (port) =>
    port === 3000 ? { pid: 42, program: 'node signaling/src/main.ts' } : null,
  );
  return failure === null ? null : `${failure.message} → ${failure.remedy}`;
}

const listen = { syscall: 'listen', address: '127.0.0.1' };

test('a port that is in use: by which program, and which option changes it', () => {
  expect(of({ ...listen, code: 'EADDRINUSE', port: 3000 })).toBe(
    '127.0.0.1:3000 is already used by node signaling/src/main.ts (process 42) → set --port to another port, or stop that program',
  );
  expect(of({ ...listen, code: 'EADDRINUSE', port: 9400 }, false)).toBe(
    '127.0.0.1:9400 is already used by another program → set --admin-port to another port, or stop that program',
  );
  expect(of({ ...listen, code: 'EADDRINUSE', port: 3001 })).toContain('→ choose another port');
});

test('an address that is another machine’s, a port for root only', () => {
  expect(of({ ...listen, code: 'EADDRNOTAVAIL', address: '10.9.9.9', port: 9400 })).toMatch(
    /^10\.9\.9\.9 is not an address of this machine → set --admin-host to/,
  );
  expect(of({ ...listen, code: 'EACCES', port: 80 })).toContain('this user may not listen on');
  expect(of({ ...listen, code: 'ESTRANGE', port: 80 })).toContain('cannot listen on 127.0.0.1:80: ESTRANGE');
});

test('a missing file: which option names it', () => {
  expect(of({ syscall: 'open', code: 'ENOENT', path: '/data/a.mcap' })).toBe(
    '/data/a.mcap does not exist → set --path to another path',
  );
  expect(of({ syscall: 'scandir', code: 'ENOTDIR', path: '/etc/hosts' })).toMatch(
    /^\/etc\/hosts is not a folder.* → check that it exists/,
  );
});

test('other errors keep their stack', () => {
  expect(of({})).toBeNull();
  expect(of({ code: 'ERR_INVALID_ARG_TYPE' })).toBeNull();
  expect(startFailureOf('a word', definition, values)).toBeNull();
  const own = new StartFailure('no camera', 'plug it in');
  expect(startFailureOf(own, definition, values)).toBe(own);
});
