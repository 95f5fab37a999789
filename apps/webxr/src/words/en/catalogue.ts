/**
 * All that the page says, in English, by area. A text is a string, or a function of what it names; a table by a value of the
 * protocol must be complete (`satisfies Record<…>`). Modules in `words/` decide which text is said, and know no language.
 */
import { access } from './access.ts';
import { capture } from './capture.ts';
import { clouds } from './clouds.ts';
import { commands } from './commands.ts';
import { dialogs } from './dialogs.ts';
import { driving } from './driving.ts';
import { failures } from './failures.ts';
import { figures } from './figures.ts';
import { fleet } from './fleet.ts';
import { headset } from './headset.ts';
import { inputs } from './inputs.ts';
import { link } from './link.ts';
import { measures } from './measures.ts';
import { media } from './media.ts';
import { motion } from './motion.ts';
import { page } from './page.ts';
import { people } from './people.ts';
import { settings } from './settings.ts';
import { stop } from './stop.ts';
import { timing } from './timing.ts';
import { wall } from './wall.ts';
import { watch } from './watch.ts';

export const english = {
  access,
  capture,
  clouds,
  commands,
  dialogs,
  driving,
  failures,
  figures,
  fleet,
  headset,
  inputs,
  link,
  measures,
  media,
  motion,
  page,
  people,
  settings,
  stop,
  timing,
  wall,
  watch,
};

/** What a catalogue of any language has. */
export type Texts = typeof english;
