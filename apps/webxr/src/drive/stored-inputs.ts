/** The choices about keys, controllers and speed that this browser keeps. */
import { choicesText, DEFAULT_CHOICES, type InputChoices, parseChoices } from './input-choices.ts';

const KEY = 'farpoint.inputs';

export function loadInputs(): InputChoices {
  try {
    return parseChoices(localStorage.getItem(KEY));
  } catch {
    return DEFAULT_CHOICES;
  }
}

export function storeInputs(choices: InputChoices): void {
  try {
    localStorage.setItem(KEY, choicesText(choices));
  } catch {
    // Private browsing: what is chosen lasts for this visit only.
  }
}
