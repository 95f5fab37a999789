/** A request for the drive or an offer of it: what another operator wants, with two answers, and what one waits for. */
import type { PeopleRequests } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { PageState } from '../../state/page-state.ts';
import type { PeopleState, ShownHandover } from '../../state/people-state.ts';
import { askedWords, waitingWords } from '../../words/handover-words.ts';
import { elements } from './elements.ts';

export function showHandovers({ people: state, link }: PageState, requests: PeopleRequests): void {
  const { asked, own } = state;
  const { handover, handoverAsked, handoverAskedText, handoverAskedLeft } = elements;
  const { handoverAccept, handoverRefuse } = elements;
  const { handoverOwn, handoverOwnText, handoverOwnLeft, handoverWithdraw } = elements;
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
  effect(() => {
    // Nothing can be answered to a robot that does not hear.
    for (const button of [handoverAccept, handoverRefuse, handoverWithdraw])
      button.disabled = !link.heard.value;
  });
  onClick(handoverAccept, asked, (id) => requests.answer(id, true));
  onClick(handoverRefuse, asked, (id) => requests.answer(id, false));
  onClick(handoverWithdraw, own, (id) => requests.withdraw(id));
}

function onClick(button: HTMLButtonElement, of: PeopleState['asked'], act: (id: number) => void): void {
  button.addEventListener('click', () => {
    // The space bar stays the drive grip.
    button.blur();
    const id = of.peek()?.id;
    if (id !== undefined) act(id);
  });
}

function leftWords(shown: ShownHandover | null): string {
  return shown === null ? '' : `${shown.leftS} s`;
}

/** Writing the same text again would announce it again. */
function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
