/** The way to the dialog for keys, gamepads, wheels and joysticks: a button in the settings. */
import { effect } from '@preact/signals-core';
import type { Notices } from '../../state/notices.ts';
import { texts } from '../../words/language.ts';
import { elements } from '../ui/elements.ts';
import { LaterPart } from '../ui/later-part.ts';
import { dialogButton, paragraphOf } from './dialog-parts.ts';
import type { InputsDialogParts } from './inputs-dialog.ts';

/** Puts the button into the settings that opens the dialog. @returns opens it from elsewhere */
export function startInputsDialog(parts: InputsDialogParts, notices: Pick<Notices, 'tell'>): () => void {
  const dialog = document.createElement('dialog');
  dialog.id = 'inputs';
  dialog.setAttribute('aria-labelledby', 'inputs-title');
  document.body.append(dialog);
  const field = document.createElement('fieldset');
  const legend = document.createElement('legend');
  const row = paragraphOf('', 'row');
  const code = new LaterPart(() => import('./inputs-dialog.ts'), notices);
  const open = () => void code.use(({ openInputs }) => openInputs(dialog, parts));
  const button = dialogButton('', '', open);
  button.id = 'inputs-open';
  effect(() => {
    const { section, open: name } = texts().inputs;
    legend.textContent = section;
    button.textContent = name;
    button.ariaLabel = name;
  });
  row.append(button);
  field.append(legend, row);
  elements.settings.querySelector('.fields > fieldset')?.after(field);
  return open;
}
