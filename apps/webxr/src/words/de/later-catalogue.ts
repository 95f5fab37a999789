import type { LaterTexts } from '../en/later-catalogue.ts';
import { controllerLabels } from './controller-labels.ts';
import { dashboard } from './dashboard.ts';
import { events } from './events.ts';
import { headsetMenu } from './headset-menu.ts';
import { help } from './help.ts';
import { inputsDialog } from './inputs-dialog.ts';
import { report } from './report.ts';

export const laterGerman: LaterTexts = {
  controllerLabels,
  dashboard,
  events,
  headsetMenu,
  help,
  inputsDialog,
  report,
};
