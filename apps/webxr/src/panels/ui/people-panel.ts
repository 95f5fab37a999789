/** Who has a session with the robot, and what this operator may do with each: offer the drive, end the session. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect } from '@preact/signals-core';
import type { PageState } from '../../state/page-state.ts';
import { peopleShown } from '../../state/shown-people.ts';
import { texts } from '../../words/language.ts';
import type { ShownPerson } from '../../words/people-words.ts';
import { elements } from './elements.ts';
import { showHandOver } from './hand-over-dialog.ts';
import { showHandovers } from './handover-panel.ts';
import { openDialog } from './open-dialog.ts';

type PeopleClient = Pick<RobotClient, 'endSession' | 'people' | 'driver'>;

export function showPeople(state: PageState, client: PeopleClient): void {
  const { driving } = state;
  const { people, peopleLine, peopleList, peopleAsk } = elements;
  // A button that is made anew loses the focus.
  const shown = peopleShown(state);
  effect(() => {
    const { line, persons, mayAsk } = shown.value;
    people.hidden = line === null;
    peopleLine.textContent = line ?? '';
    peopleAsk.hidden = !mayAsk;
    const focused = peopleList.contains(document.activeElement) ? document.activeElement?.ariaLabel : null;
    peopleList.replaceChildren(...persons.map((person) => itemOf(person, client)));
    for (const button of peopleList.querySelectorAll('button'))
      if (button.ariaLabel === focused) button.focus();
  });
  peopleAsk.addEventListener('click', () => {
    peopleAsk.blur();
    client.people.askToDrive();
  });
  showHandOver({ shown, drives: computed(() => driving.holder.value === 'you'), client });
  showHandovers(state, client.people);
}

function itemOf({ number, name, text, mayOffer, mayEnd }: ShownPerson, client: PeopleClient): HTMLLIElement {
  const [item, label] = [document.createElement('li'), document.createElement('span')];
  label.textContent = text;
  item.append(label);
  const add = (words: string, ariaLabel: string, act: () => void) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'quiet';
    button.textContent = words;
    button.ariaLabel = ariaLabel;
    button.addEventListener('click', () => {
      button.blur();
      act();
    });
    item.append(button);
  };
  const said = texts().people;
  if (mayOffer) add(said.offer, said.offerTo(name), () => client.people.offerDrive(number));
  if (mayEnd)
    add(said.end, said.endOf(name), () => confirmEnd(name, (block) => client.endSession(number, { block })));
  return item;
}

function confirmEnd(name: string, onEnd: (block: boolean) => void): void {
  const { endSession, endSessionTitle, endSessionBlock } = elements;
  endSessionTitle.textContent = texts().people.endTitle(name);
  endSessionBlock.checked = false;
  endSession.addEventListener(
    'close',
    () => {
      if (endSession.returnValue === 'end') onEnd(endSessionBlock.checked);
    },
    { once: true },
  );
  openDialog(endSession);
}
