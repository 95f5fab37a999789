/** What the parts of the page say that are loaded when they are first opened: dialogs, the dashboard, the headset's menu. */
import { controllerLabels } from './controller-labels.ts';
import { dashboard } from './dashboard.ts';
import { events } from './events.ts';
import { headsetMenu } from './headset-menu.ts';
import { help } from './help.ts';
import { inputsDialog } from './inputs-dialog.ts';
import { report } from './report.ts';

export const laterEnglish = {
  controllerLabels,
  dashboard,
  events,
  headsetMenu,
  help,
  inputsDialog,
  report,
};

/** What such a catalogue of any language has. */
export type LaterTexts = typeof laterEnglish;
