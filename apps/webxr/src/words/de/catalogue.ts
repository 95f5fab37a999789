/** All that the page says, in German: addresses the operator with “Sie”, and names parts as the English catalogue does. */
import type { Texts } from '../en/catalogue.ts';
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

export const german: Texts = {
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
