/** Who has a session with the robot; for supervisors, also a way to end another's. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect } from '@preact/signals-core';
import type { PageState } from '../../state/page-state.ts';
import { steady } from '../../state/sampler.ts';
import { type ShownPerson, shownPeople } from '../../words/people-words.ts';
import { elements } from './elements.ts';
import { openDialog } from './open-dialog.ts';

export function showPeople({ robot, driving }: PageState, client: Pick<RobotClient, 'endSession'>): void {
  const { people, peopleLine, peopleList } = elements;
  // A button that is made anew loses the focus.
  const shown = steady(
    computed(() => shownPeople(robot.operators.value, driving.role.value === 'supervise')),
  );
  effect(() => {
    const { line, persons } = shown.value;
    people.hidden = line === null;
    peopleLine.textContent = line ?? '';
    peopleList.replaceChildren(...persons.map((person) => itemOf(person, client)));
  });
}

function itemOf(person: ShownPerson, client: Pick<RobotClient, 'endSession'>): HTMLLIElement {
  const [item, label] = [document.createElement('li'), document.createElement('span')];
  label.textContent = person.text;
  item.append(label);
  const { number, name } = person;
  if (person.mayEnd) {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'quiet';
    button.textContent = 'End session…';
    button.ariaLabel = `End the session of ${name}…`;
    button.addEventListener('click', () => {
      button.blur();
      confirmEnd(name, (block) => client.endSession(number, { block }));
    });
    item.append(button);
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
