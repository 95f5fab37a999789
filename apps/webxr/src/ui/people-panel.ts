/** Who has a session with the robot, and what this operator may do with each: offer the drive, end the session. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect } from '@preact/signals-core';
import type { PageState } from '../state/page-state.ts';
import { steady } from '../state/steady.ts';
import { type ShownPerson, shownPeople } from '../status/people-words.ts';
import { showChat } from './chat-panel.ts';
import { keepInRoom } from './controls-room.ts';
import { elements } from './elements.ts';
import { showHandovers } from './handover-panel.ts';
import { openDialog } from './open-dialog.ts';

type PeopleClient = Pick<RobotClient, 'endSession' | 'people'>;

export function showPeople(state: PageState, client: PeopleClient): void {
  const { robot, driving, people: others, sampledAtMs } = state;
  const { people, peopleLine, peopleList, peopleAsk } = elements;
  keepInRoom(people);
  // A button that is made anew loses the focus.
  const shown = steady(
    computed(() => {
      const since = others.drivesSinceMs.value;
      return shownPeople({
        ...{ operators: robot.operators.value, role: driving.role.value, holder: driving.holder.value },
        waits: others.own.value !== null,
        drivesMinutes: since === null ? null : Math.floor((sampledAtMs.value - since) / 60_000),
      });
    }),
  );
  effect(() => {
    const { line, persons, mayAsk } = shown.value;
    people.hidden = line === null;
    peopleLine.textContent = line ?? '';
    peopleAsk.hidden = !mayAsk;
    peopleList.replaceChildren(...persons.map((person) => itemOf(person, client)));
  });
  peopleAsk.addEventListener('click', () => {
    peopleAsk.blur();
    client.people.askToDrive();
  });
  showHandovers(others, client.people);
  showChat(state, client.people);
}

function itemOf(person: ShownPerson, client: PeopleClient): HTMLLIElement {
  const [item, label] = [document.createElement('li'), document.createElement('span')];
  label.textContent = person.text;
  item.append(label);
  const { number, name } = person;
  const add = (text: string, ariaLabel: string, act: () => void) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'quiet';
    button.textContent = text;
    button.ariaLabel = ariaLabel;
    button.addEventListener('click', () => {
      button.blur();
      act();
    });
    item.append(button);
  };
  if (person.mayOffer) {
    add('Offer the drive', `Offer the drive to ${name}`, () => client.people.offerDrive(number));
  }
  if (person.mayEnd) {
    add('End session…', `End the session of ${name}…`, () =>
      confirmEnd(name, (block) => client.endSession(number, { block })),
    );
  }
  return item;
}

function confirmEnd(name: string, onEnd: (block: boolean) => void): void {
  const { endSession, endSessionTitle, endSessionBlock } = elements;
  endSessionTitle.textContent = `End the session of ${name}?`;
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
