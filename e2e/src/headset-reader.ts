import type { ConsoleProbe } from '@farpoint/webxr/test-api';
import type { Page } from '@playwright/test';
import { expect } from './expect.ts';
import type { Hand, Headset } from './headset.ts';

/** Height of the eyes, which are the origin of the operator's room in the page, m. */
const EYES_M = 1.6;
/** From a hand to what it points at, m. */
const POINTS_FROM_M = 0.4;

type Place = [x: number, y: number, z: number];

/** Buttons of the emulated controllers, by the control that a label names. */
const BUTTONS = {
  ...{ grip: { left: 'squeeze', right: 'squeeze' }, trigger: { left: 'trigger', right: 'trigger' } },
  ...{ stick: { left: 'thumbstick', right: 'thumbstick' } },
  ...{ stickPress: { left: 'thumbstick', right: 'thumbstick' } },
  ...{ lower: { left: 'x-button', right: 'a-button' }, upper: { left: 'y-button', right: 'b-button' } },
} as const;

/** Somebody in the headset who knows only what is written there. */
export class HeadsetReader {
  readonly #page: Page;
  readonly #headset: Headset;

  constructor(page: Page, headset: Headset) {
    this.#page = page;
    this.#headset = headset;
  }

  async console(): Promise<ConsoleProbe> {
    const shown = await this.#page.evaluate(() => window.farpoint.console());
    if (shown === null) throw new Error('not in VR');
    return shown;
  }

  /**
   * Waits for a label that says this.
   *
   * @param meanwhile done before each look
   * @returns the hand and the button that it is on
   */
  async find(
    says: RegExp,
    meanwhile: () => Promise<void> = async () => {},
  ): Promise<{ hand: Hand; button: string; text: string }> {
    const found = async () => (await this.console()).labels.find(({ text }) => says.test(text));
    const look = async () => {
      await meanwhile();
      return found();
    };
    let label: Awaited<ReturnType<typeof look>>;
    await expect
      .poll(
        async () => {
          label = await look();
          return label;
        },
        { message: `label ${says}` },
      )
      .toBeDefined();
    if (label === undefined) throw new Error(`no label ${says}`);
    const { hand, text } = label;
    return { hand, text, button: BUTTONS[label.control as keyof typeof BUTTONS][hand] };
  }

  /** Presses the button whose label says this. */
  async press(says: RegExp): Promise<void> {
    const { hand, button } = await this.find(says);
    await this.#headset.press(hand, button);
  }

  /** Titles and rows of the menu; `null` while it is closed. */
  async menu(): Promise<string[] | null> {
    const { menu } = await this.console();
    return menu === null ? null : [menu.title, ...menu.items.map(({ text }) => text)];
  }

  /** Moves the mark to the row that says this, by the stick, and chooses it, as the labels say. */
  async chooseByStick(says: RegExp): Promise<void> {
    const { hand } = await this.find(/up, down/);
    const marked = async () => {
      const { menu } = await this.console();
      return menu?.items[menu.marked]?.text ?? '';
    };
    for (let tried = 0; tried < 15 && !says.test(await marked()); tried++) {
      await this.#headset.thumbstick(hand, 0, 1);
      await this.#headset.frames(3);
      await this.#headset.thumbstick(hand, 0, 0);
      await this.#headset.frames(3);
    }
    expect(await marked()).toMatch(says);
    await this.press(/Press stick: choose/);
  }

  /** Where a hand is that points at the row that says this, in the emulated room. */
  async before(says: RegExp): Promise<Place> {
    const row = async () => {
      const { menu } = await this.console();
      const index = menu?.items.findIndex(({ text }) => says.test(text)) ?? -1;
      return menu?.places[index];
    };
    await expect.poll(row, { message: `row ${says}` }).toBeDefined();
    return pointing((await row()) as Place);
  }

  /** Where a hand is that points at STOP or at the menu on the wrist. */
  async beforeTab(part: 'stop' | 'menu'): Promise<Place> {
    const { tab } = await this.console();
    if (tab === null) throw new Error('nothing of that on the wrist');
    return pointing(tab[part]);
  }

  /** Points at the row that says this, and pulls the trigger. */
  async chooseByRay(hand: Hand, says: RegExp): Promise<void> {
    await this.#headset.place(hand, await this.before(says));
    await this.#headset.frames(3);
    await this.#headset.press(hand, 'trigger');
  }

  /** What is said before the eyes. */
  async notice(): Promise<string> {
    return (await this.console()).notice?.rows.join(' ') ?? '';
  }
}

function pointing([x, y, z]: Place): Place {
  return [x, y + EYES_M, z + POINTS_FROM_M];
}
