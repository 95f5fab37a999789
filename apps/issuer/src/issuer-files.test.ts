import { OptionsError } from '@farpoint/service';
import { uselessFiles } from '@farpoint/service/testing/useless-files';
import { expect, it } from 'vitest';
import { readSigningKey } from './issuer-files.ts';

it.each(uselessFiles())('a key that is $what is refused', async ({ path, words }) => {
  const error = await readSigningKey('--key', path).catch((thrown: unknown) => thrown);
  expect(error).toBeInstanceOf(OptionsError);
  const { message } = error as OptionsError;
  expect(message.startsWith('--key ')).toBe(true);
  expect(message).toContain(path);
  expect(message).toContain(words);
});
