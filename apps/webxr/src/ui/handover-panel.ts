/** A request for the drive or an offer of it: what another operator wants, with two answers, and what one waits for. */
import type { PeopleRequests } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { PeopleState, ShownHandover } from '../people/people-state.ts';
import { askedWords, waitingWords } from '../status/handover-words.ts';
import { elements } from './elements.ts';

export function showHandovers({ asked, own }: PeopleState, people: PeopleRequests): void {
  const { handoverAsked, handoverAskedText, handoverAskedLeft, handoverAccept, handoverRefuse } = elements;
  const { handover, handoverOwn, handoverOwnText, handoverOwnLeft, handoverWithdraw } = elements;
  effect(() => {
    const [theirs, mine] = [asked.value, own.value];
    handover.hidden = theirs === null && mine === null;
    handoverAsked.hidden = theirs === null;
    handoverOwn.hidden = mine === null;
    const words = theirs === null ? null : askedWords(theirs);
    say(handoverAskedText, words?.text ?? '');
    say(handoverAccept, words?.accept ?? '');
    say(handoverRefuse, words?.refuse ?? '');
    say(handoverAskedLeft, leftWords(theirs));
    say(handoverOwnText, mine === null ? '' : waitingWords(mine));
    say(handoverOwnLeft, leftWords(mine));
  });
  const onClick = (button: HTMLButtonElement, of: PeopleState['asked'], act: (id: number) => void) =>
    button.addEventListener('click', () => {
      button.blur();
      const id = of.peek()?.id;
      if (id !== undefined) act(id);
    });
  onClick(handoverAccept, asked, (id) => people.answer(id, true));
  onClick(handoverRefuse, asked, (id) => people.answer(id, false));
  onClick(handoverWithdraw, own, (id) => people.withdraw(id));
}

function leftWords(shown: ShownHandover | null): string {
  return shown === null ? '' : `${shown.leftS} s`;
}

/** Writing the same text again would announce it again. */
function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
