/** An entry of the headset's menu: what it says, and what it does. */
import type { Words } from '../../words/words.ts';
import type { ConsoleActions } from './console-actions.ts';

export type MenuPageName =
  | 'main'
  | 'robots'
  | 'people'
  | 'views'
  | 'cameras'
  | 'camera'
  | 'commands'
  | 'readings'
  | 'times';

/** Which page is open. */
export interface MenuPlace {
  readonly page: MenuPageName;
  /**
   * The entry of its list that comes first; of a camera's page, that camera; of commands, which page of them; of times, 0: clouds,
   * 1: commands.
   */
  readonly first: number;
}

export interface MenuItem {
  readonly text: string;
  /** Below the text. An entry that has it, may it be empty, has two rows at all times. */
  readonly note?: string;
  /** `null`: it only says something. */
  readonly choice: Choice | null;
  readonly tone?: Words['tone'] | 'chosen' | 'quiet';
}

type Choice = { readonly act: (actions: ConsoleActions) => void; readonly closes: boolean } | MenuPlace;
