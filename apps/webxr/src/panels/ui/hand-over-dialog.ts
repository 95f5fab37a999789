/** To whom the drive is handed: the driver offers it to another operator, or gives it up. */
import type { RobotClient } from '@farpoint/operator';
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { texts } from '../../words/language.ts';
import type { ShownPeople } from '../../words/people-words.ts';
import { elements } from './elements.ts';
import { openDialog } from './open-dialog.ts';
import { quietButton } from './panel-parts.ts';

export interface HandOverParts {
  readonly shown: ReadonlySignal<ShownPeople>;
  /** Whether this operator drives. */
  readonly drives: ReadonlySignal<boolean>;
  readonly client: Pick<RobotClient, 'people' | 'driver'>;
}

export function showHandOver({ shown, drives, client }: HandOverParts): void {
  const { release, handOver, handOverList, handOverHint, handOverGiveUp } = elements;
  effect(() => {
    const said = texts().people;
    release.textContent = shown.value.hasHeirs ? said.handOver : said.giveUp;
  });
  effect(() => {
    const said = texts().people;
    const heirs = shown.value.persons.filter(({ mayOffer }) => mayOffer);
    const offers = heirs.map(({ number, text, name }) => {
      const button = quietButton(said.offerItTo(text), said.offerTo(name), () => {
        client.people.offerDrive(number);
        handOver.close();
      });
      const item = document.createElement('li');
      item.append(button);
      return item;
    });
    handOverList.replaceChildren(...offers);
    handOverHint.hidden = heirs.length > 0;
  });
  effect(() => {
    if (!drives.value) handOver.close();
  });
  release.addEventListener('click', () => {
    release.blur();
    if (shown.peek().hasHeirs) openDialog(handOver);
    else client.driver.releaseLease();
  });
  handOverGiveUp.addEventListener('click', () => {
    handOver.close();
    client.driver.releaseLease();
  });
}
