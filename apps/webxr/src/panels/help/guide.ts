/** Opens the help and the first drive. The code of each is loaded when it is first needed. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { LiveSettings } from '../../ground/live-settings.ts';
import { rememberTour, wasTourShown } from '../../ground/stored-tour.ts';
import type { PageState } from '../../state/page-state.ts';
import { inputSettings } from '../../take/drive/stored-inputs.ts';
import { texts } from '../../words/language.ts';
import { elements } from '../ui/elements.ts';
import { LaterPart } from '../ui/later-part.ts';
import { isDialogOpen } from '../ui/open-dialog.ts';
import type { OperatorInputs } from '../ui/operator-inputs.ts';
import type { openHelp } from './help-dialog.ts';

export interface GuideParts {
  readonly client: RobotClient;
  readonly state: PageState;
  /** `tour`: whether the first drive is shown by itself. */
  readonly settings: Pick<LiveSettings, 'tour'>;
  readonly inputs: Pick<OperatorInputs, 'pause'>;
  readonly inVr: ReadonlySignal<boolean>;
}

export class Guide {
  readonly #parts: GuideParts;
  readonly #dialog = document.createElement('dialog');
  /** Whether there is a robot to drive, and a screen on which to read. */
  readonly #canTour: ReadonlySignal<boolean>;
  readonly #helpCode;
  readonly #tourCode;
  #openInputs: () => void = () => undefined;
  #endTour: (() => void) | null = null;

  constructor(parts: GuideParts) {
    this.#parts = parts;
    const { link, robot, notices } = parts.state;
    this.#helpCode = new LaterPart(() => import('./help-dialog.ts'), notices);
    this.#tourCode = new LaterPart(() => import('./tour-panel.ts'), notices);
    this.#canTour = computed(() => link.live.value && robot.drives.value && !parts.inVr.value);
    this.#dialog.id = 'help';
    this.#dialog.setAttribute('aria-labelledby', 'help-title');
    document.body.append(this.#dialog);
  }

  /** @param openInputs opens the dialog in which keys and devices are chosen */
  start(openInputs: () => void): void {
    this.#openInputs = openInputs;
    elements.helpOpen.addEventListener('click', () => this.toggleHelp());
    if (this.#parts.settings.tour && !wasTourShown()) this.#startWhenPossible();
  }

  /** Opens the help, unless a grip is held or another dialog is open; or closes it. */
  toggleHelp(): void {
    if (this.#dialog.open) {
      this.#dialog.close();
      return;
    }
    const { state, inVr } = this.#parts;
    if (inVr.peek()) {
      state.notices.tell(texts().dialogs.leaveVr);
      return;
    }
    if (!this.#mayOpen()) return;
    void this.#helpCode.use(({ openHelp }) => {
      // A hand may have taken the grip while the code was loaded.
      if (!this.#dialog.open && this.#mayOpen()) this.#open(openHelp);
    });
  }

  #mayOpen(): boolean {
    const { client, state } = this.#parts;
    if (isDialogOpen()) return false;
    if (!client.driver.isGripped) return true;
    state.notices.tell(texts().dialogs.letGoFirst);
    return false;
  }

  #open(open: typeof openHelp): void {
    const resume = this.#parts.inputs.pause();
    open(this.#dialog, {
      settings: inputSettings,
      canTour: this.#canTour.peek(),
      startTour: () => this.#startTour(),
      openInputs: () => this.#openInputs(),
      onClosed: resume,
    });
  }

  /** Shows the first drive at the first session in which this operator may drive, and nobody else does. */
  #startWhenPossible(): void {
    const { driving, link } = this.#parts.state;
    const dispose = effect(() => {
      const mayDrive = driving.role.value !== 'watch' && driving.holder.value !== 'other';
      if (!this.#canTour.value || !link.heard.value || !mayDrive) return;
      this.#startTour();
      // An effect cannot end itself while it runs for the first time.
      queueMicrotask(() => dispose());
    });
  }

  #startTour(): void {
    this.#end();
    const { client, state } = this.#parts;
    void this.#tourCode.use(({ showTour }) => {
      this.#endTour = showTour({
        client,
        state,
        settings: inputSettings,
        canTour: this.#canTour,
        onDone: rememberTour,
        onEnd: () => {
          rememberTour();
          this.#end();
        },
      });
    });
  }

  #end(): void {
    this.#endTour?.();
    this.#endTour = null;
  }
}
