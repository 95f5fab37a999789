import type { SignInRequest } from '@farpoint/protocol';
import { escapeHtml, page } from './page.ts';
import { CODE_DIGITS } from './pairing-codes.ts';
import type { PairingPrompt } from './pairing-desk.ts';

const WORDS: Readonly<Record<PairingPrompt, string>> = {
  type: '',
  wrong: 'That is not the code. Look at it again.',
  'used-up': 'That was not the code either. For ten minutes, no code is accepted.',
  expired: 'That code is no longer valid. There is a new one now.',
  paused: 'There were too many wrong codes. For ten minutes, no code is accepted.',
};

/** Asks for the pairing code, by a form without a script. */
export function pairingPage({ key, return: back, state }: SignInRequest, prompt: PairingPrompt): string {
  const hidden = Object.entries({ key, return: back, ...(state === null ? {} : { state }) })
    .map(([name, value]) => `<input type="hidden" name="${name}" value="${escapeHtml(value)}">`)
    .join('');
  const words = WORDS[prompt] === '' ? '' : `<p class="warning" role="alert">${WORDS[prompt]}</p>`;
  const isPaused = prompt === 'paused' || prompt === 'used-up';
  const form = `<form method="post" action="pair">${hidden}<label for="code">Code</label>
<input id="code" name="code" inputmode="numeric" autocomplete="one-time-code" pattern="[0-9 ]{${CODE_DIGITS},}" maxlength="${CODE_DIGITS + 2}" required autofocus>
<button>Pair</button></form>`;
  return page(
    'Pair this browser',
    `${words}<p>The computer that runs Farpoint shows a code of ${CODE_DIGITS} digits in its terminal.</p>${isPaused ? '' : form}
<p><a href="${escapeHtml(back)}">Back to the robots</a></p>`,
  );
}
