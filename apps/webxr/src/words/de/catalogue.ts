/** All that the page says, in German: addresses the operator with “Sie”, and names parts as the English catalogue does. */
import type { Texts } from '../en/catalogue.ts';
import { access } from './access.ts';
import { capture } from './capture.ts';
import { clouds } from './clouds.ts';
import { commands } from './commands.ts';
import { controllerLabels } from './controller-labels.ts';
import { dashboard } from './dashboard.ts';
import { dialogs } from './dialogs.ts';
import { driving } from './driving.ts';
import { events } from './events.ts';
import { failures } from './failures.ts';
import { figures } from './figures.ts';
import { fleet } from './fleet.ts';
import { headset } from './headset.ts';
import { headsetMenu } from './headset-menu.ts';
import { help } from './help.ts';
import { inputs } from './inputs.ts';
import { link } from './link.ts';
import { measures } from './measures.ts';
import { media } from './media.ts';
import { motion } from './motion.ts';
import { page } from './page.ts';
import { people } from './people.ts';
import { report } from './report.ts';
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
  controllerLabels,
  dashboard,
  dialogs,
  driving,
  events,
  failures,
  figures,
  fleet,
  headset,
  headsetMenu,
  help,
  inputs,
  link,
  measures,
  media,
  motion,
  page,
  people,
  report,
  settings,
  stop,
  timing,
  wall,
  watch,
};
