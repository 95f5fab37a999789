import { expect, it } from 'vitest';
import * as z from 'zod';
import { defineOption } from './option-table.ts';
import { publicValues } from './public-values.ts';

const any = z.unknown();
const table = {
  token: defineOption({ schema: any, default: null, help: '', secret: true }),
  otherToken: defineOption({ schema: any, default: null, help: '', secret: true }),
  limit: defineOption({ schema: any, default: 1, help: '' }),
  same: defineOption({ schema: any, default: ['a'], help: '' }),
  max: defineOption({ schema: any, default: 5, help: '' }),
  camera: defineOption({ schema: any, default: [], help: '' }),
  url: defineOption({ schema: any, default: '', help: '' }),
};

it('shows what differs from the defaults, and of secrets only that they are set', () => {
  const shown = publicValues(table, {
    ...{ token: 'hunter2', otherToken: null, limit: 2, same: ['a'], max: Number.POSITIVE_INFINITY },
    camera: [
      { source: { uri: 'rtsp://admin:hunter2@10.0.0.7/1', password: 'hunter2' }, adminKey: 'hunter2' },
    ],
    url: 'wss://user:hunter2@example.org/a?b=c',
  });
  expect(shown).toEqual({
    ...{ token: 'set', limit: 2, max: 'infinite' },
    camera: [{ source: { uri: 'rtsp://…@10.0.0.7/1', password: 'set' }, adminKey: 'set' }],
    url: 'wss://…@example.org/a?b=c',
  });
  expect(JSON.stringify(shown)).not.toContain('hunter2');
});
