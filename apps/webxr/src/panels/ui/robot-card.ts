/** A robot in the list: its name, what it does, and how it was last seen here. */
import type { LastPicture } from '../../ground/pictures/last-pictures.ts';
import { type ListedRobot, seenWords } from '../../words/fleet-words.ts';
import { texts } from '../../words/language.ts';

export class RobotCard {
  readonly element = document.createElement('li');
  readonly #button = document.createElement('button');
  readonly #name = document.createElement('span');
  readonly #id = document.createElement('small');
  readonly #words = document.createElement('span');
  readonly #picture = document.createElement('img');
  readonly #age = document.createElement('small');
  #shown = '';
  #drawnMs: number | null = null;

  constructor(robotId: string, onChoose: (robotId: string) => void) {
    this.#button.type = 'button';
    this.#button.dataset.robot = robotId;
    this.#button.addEventListener('click', () => onChoose(robotId));
    this.#name.className = 'name';
    this.#words.className = 'words';
    this.#age.className = 'age';
    // What it shows is said in words beside it.
    this.#picture.alt = '';
    this.#picture.decoding = 'async';
    this.#button.append(this.#picture, this.#name, this.#id, this.#words, this.#age);
    this.element.append(this.#button);
    this.showPicture(null, 0);
  }

  /** Touches the document only if something has changed. */
  show(robot: ListedRobot): void {
    const text = JSON.stringify(robot);
    if (text === this.#shown) return;
    this.#shown = text;
    const { id, name, words, version } = robot;
    this.#name.textContent = name;
    this.#id.textContent = id;
    this.#button.title = version === null ? '' : texts().fleet.version(version);
    this.#words.hidden = words.length === 0;
    this.#words.replaceChildren(
      ...words.flatMap(({ text: said, tone }) => {
        const word = document.createElement('span');
        word.textContent = said;
        word.dataset.tone = tone;
        // Screen readers read the words apart.
        return [word, ' '];
      }),
    );
  }

  /** @param unixMs the time of day */
  showPicture(picture: LastPicture | null, unixMs: number): void {
    this.#picture.hidden = picture === null;
    this.#age.hidden = picture === null;
    this.#drawnMs = picture?.drawnMs ?? null;
    if (picture === null) return;
    if (this.#picture.src !== picture.url) this.#picture.src = picture.url;
    this.showAge(unixMs);
  }

  showAge(unixMs: number): void {
    if (this.#drawnMs === null) return;
    const text = seenWords(unixMs - this.#drawnMs);
    if (this.#age.textContent !== text) this.#age.textContent = text;
  }
}
