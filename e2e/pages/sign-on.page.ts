/** Signing in for a grant, at an issuer of which the test says what it answers. */
import { type SignInAnswer, signInAnswerHash } from '@farpoint/protocol';
import type { Page } from '@playwright/test';
import { admit, grantFor, grantsDialog, storedKey } from '../src/stage/grants.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const SIGN_IN = 'https://issuer.example/sign-in';

/** Opens the page at a robot that asks for a grant. @param answer with which the browser comes back from the issuer */
async function openAt(stage: Stage, answer: SignInAnswer | null = null): Promise<Page> {
  const hash = answer === null ? '' : signInAnswerHash(answer);
  const page = await stage.open({ state: 'not-granted', query: { token: 'secret' }, hash });
  await stage.script(({ link }, url) => {
    link.signInUrl = url;
  }, SIGN_IN);
  await stage.run(300);
  return page;
}

/** The page leaves for the issuer, when this is done. @returns what it asks the issuer for */
async function askedBy(page: Page, act: () => Promise<void>): Promise<Record<string, string>> {
  const leaves = page.waitForRequest((request) => request.url().startsWith(SIGN_IN));
  await act();
  const asked = Object.fromEntries(new URL((await leaves).url()).searchParams);
  await page.waitForURL(`${SIGN_IN}*`);
  return asked;
}

test('who signs in drives; what the issuer refuses is said, and a grant that nobody asked for is only offered', async ({
  stage,
}) => {
  const page = await openAt(stage);
  await page.route(`${SIGN_IN}*`, (route) =>
    route.fulfill({ contentType: 'text/html', body: 'Who are you?' }),
  );
  const { own, read, held, signIn } = grantsDialog(page);
  const obstacle = page.getByRole('alertdialog');
  await expect(obstacle).toContainText('Sign in to get one');
  await expect(obstacle).toContainText('You sign in at issuer.example');
  const here = new URL(page.url());
  here.searchParams.delete('token');

  const first = await askedBy(page, () => obstacle.getByRole('button', { name: 'Sign in' }).click());
  expect(first.return).toBe(here.href);
  await openAt(stage, { error: 'not-permitted', state: first.state ?? '' });
  await expect(read).toHaveText(
    'You have signed in, but nothing here is set up for you. Ask the person who issues grants.',
  );
  expect(new URL(page.url()).hash).toBe('');
  await expect(own).toHaveValue(first.key ?? '');

  const second = await askedBy(page, () => signIn.click());
  expect(second).toEqual({ ...first, state: expect.any(String) });
  expect(second.state).not.toBe(first.state);
  await openAt(stage, { error: 'provider-unreachable', state: second.state ?? '' });
  await expect(read).toHaveText('The sign-in service cannot be reached. Try again later.');

  // For this browser's key, but with a state that the page did not make, and then with one that has had its answer.
  const third = await askedBy(page, () => signIn.click());
  for (const state of ['guessed', third.state ?? '']) {
    const grant = await grantFor(third.key ?? '', { name: 'Mallory', role: 'watch' });
    await openAt(stage, { grant, state });
    await expect(read).toHaveText(/^Mallory may watch/);
    await expect(held).toHaveCount(0);
    expect((await storedKey(page))?.grants).toBe(0);
    expect((await stage.state()).session).toBe('waiting');
  }

  const fourth = await askedBy(page, () => signIn.click());
  const grant = await grantFor(fourth.key ?? '', { robots: ['stage-*'] });
  await openAt(stage, { grant, state: fourth.state ?? '' });
  await expect(page.getByText('Signed in: Ada Lovelace may drive: stage-*')).toBeVisible();
  expect(new URL(page.url()).hash).toBe('');
  expect(await storedKey(page)).toEqual({ extractable: false, grants: 1 });
  expect(await page.evaluate(() => sessionStorage.getItem('farpoint.sign-in'))).toBe(null);
  await stage.script(admit, { role: 'drive', name: 'Ada Lovelace', expiresInS: 3600 } as const);
  await obstacle.getByRole('button', { name: 'Try again' }).click();
  await stage.run(500);
  await expect(obstacle).toBeHidden();
  // That the robot is there comes at once, and does not hide who has signed in.
  await expect(page.getByText('Signed in: Ada Lovelace may drive: stage-*')).toBeVisible();
  expect((await stage.state()).session).toBe('live');
});
