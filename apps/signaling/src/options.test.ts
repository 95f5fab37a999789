import { resolveOptions } from '@farpoint/service';
import { expect, test } from 'vitest';
import { program } from './options.ts';

const origins = (text: string) => {
  const resolved = resolveOptions(program, {
    argv: ['--map-origins', text],
    env: {},
    readFile: () => null,
  });
  return resolved.action === 'run' ? resolved.values.mapOrigins : null;
};

test('servers of map tiles are https origins, so that nothing else gets into the page’s policy', () => {
  expect(origins('https://a.example,https://b.example:8443')).toEqual([
    'https://a.example',
    'https://b.example:8443',
  ]);
  for (const text of [
    'http://a.example',
    'https://a.example/x',
    'https:',
    "https://a.example; script-src 'x'",
    '*',
  ])
    expect(() => origins(text)).toThrow('https origins');
});
