/** The robot's sound and its videos, as far as the page asks for them and says what becomes of them. */
import type { Sound } from '@farpoint/protocol';
import { expect, test } from '../src/stage/page-test.ts';

const HEARD: readonly (readonly [NonNullable<Sound['microphone']>, string])[] = [
  [{ state: 'starting' }, 'The microphone starts…'],
  [{ state: 'muted' }, 'Muted while you speak'],
  [{ state: 'slow-link' }, 'Off: the connection is too slow for sound'],
  [{ state: 'failed', detail: 'unplugged' }, 'No sound: unplugged'],
  [{ state: 'live' }, 'Waiting for sound…'],
];

test('sound is asked for while it is on, and the page says what becomes of it', async ({ stage }) => {
  const page = await stage.open();
  await expect(page.locator('#sound')).toBeHidden();
  const tell = async (microphone: Sound['microphone']) => {
    await stage.tell({ type: 'sound', mid: 's0', microphone });
    await stage.run(400);
  };
  await tell({ state: 'off' });
  const panel = page.locator('#sound');
  await expect(panel).toContainText('Off');
  expect((await stage.sent('listen')).filter(({ on }) => on)).toEqual([]);
  const button = page.getByRole('button', { name: 'Sound', exact: true });
  await button.click();
  await stage.run(300);
  expect((await stage.sent('listen')).at(-1)).toEqual({ type: 'listen', on: true });
  for (const [microphone, words] of HEARD) {
    await tell(microphone);
    await expect(panel).toContainText(words);
  }
  await button.click();
  await stage.run(300);
  expect((await stage.sent('listen')).at(-1)).toEqual({ type: 'listen', on: false });
  await expect(panel).toContainText('Off');
});
