/** All that the page says, in German: addresses the operator with “Sie”, and names parts as the English catalogue does. */
import type { Texts } from '../en/catalogue.ts';
import { driving } from './driving.ts';

export const german: Texts = {
  driving,
};
