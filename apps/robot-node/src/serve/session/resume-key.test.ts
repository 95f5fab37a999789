import { expect, it } from 'vitest';
import { ResumeKey } from './resume-key.ts';

it('is 128 random bits as text, different each time, and matches only itself', () => {
  const [key, other] = [new ResumeKey(), new ResumeKey()];
  expect(Buffer.from(key.text, 'base64url')).toHaveLength(16);
  expect(key.matches(key.text)).toBe(true);
  for (const text of [
    other.text,
    '',
    key.text.slice(1),
    `${key.text}=`,
    key.text.toLowerCase(),
    'é'.repeat(9),
  ]) {
    expect(key.matches(text)).toBe(false);
  }
});
