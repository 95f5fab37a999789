/** Opens the help, the event log and the first drive. The code of each is loaded when it is first needed. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { PageState } from '../state/page-state.ts';
import { guideWords } from '../status/guide-words.ts';
import { rememberTour, wasTourShown } from '../tour/stored-tour.ts';
import { elements } from './elements.ts';
import { openDialog } from './open-dialog.ts';
import type { OperatorInputs } from './operator-inputs.ts';

export interface GuideParts {
  readonly client: RobotClient;
  readonly state: PageState;
  readonly inputs: Pick<OperatorInputs, 'settings' | 'releaseAll'>;
  readonly inVr: ReadonlySignal<boolean>;
  /** Whether the first drive is shown by itself; `null`: once to each person. */
  readonly tour: boolean | null;
  /** Saves a picture of the scene. */
  saveScene(): void;
  /** Saves the last 30 seconds of the scene. */
  saveClip(): void;
}

export class GuideUi {
  readonly #parts: GuideParts;
  /** Whether there is a robot that this operator may drive, and a screen to read on. */
  readonly #mayTour: ReadonlySignal<boolean>;
  #help: Promise<HTMLDialogElement> | null = null;
  #events: Promise<HTMLDialogElement> | null = null;
  #loadingTour = false;
  #endTour: (() => void) | null = null;

  constructor(parts: GuideParts) {
    this.#parts = parts;
    const { link, robot, driving } = parts.state;
    this.#mayTour = computed(() => {
      const isThere = link.live.value && robot.heard.value && robot.telemetry.value !== null;
      const mayDrive = robot.drives.value && driving.role.value !== 'watch';
      return isThere && mayDrive && !parts.inVr.value;
    });
  }

  start(): void {
    elements.helpOpen.addEventListener('click', () => this.openHelp());
    elements.eventsOpen.addEventListener('click', () => this.#openEvents());
    const { tour, state } = this.#parts;
    // The testing build shows it only to tests that ask for it.
    const isWanted = tour ?? (import.meta.env.MODE !== 'testing' && !wasTourShown());
    if (!isWanted) return;
    const dispose = effect(() => {
      if (!this.#mayTour.value || state.driving.holder.value === 'other') return;
      this.#startTour();
      // Once is enough. An effect cannot end itself while it runs for the first time.
      queueMicrotask(() => dispose());
    });
  }

  openHelp(): void {
    const { client, inputs, state } = this.#parts;
    const asked = client.driver.stream.asked;
    if (asked !== null && Math.hypot(asked.linear.x, asked.linear.y, asked.angular.z) > 0) {
      state.notices.tell(guideWords.driving);
      return;
    }
    this.#help ??= import('./help-dialog.ts').then(({ helpDialog }) =>
      helpDialog({
        ...{ settings: inputs.settings, mayTour: this.#mayTour },
        startTour: () => this.#startTour(),
        openEvents: () => this.#openEvents(),
        saveScene: () => this.#parts.saveScene(),
        saveClip: () => this.#parts.saveClip(),
        openInputs: () => elements.inputsOpen.click(),
      }),
    );
    this.#open(this.#help, guideWords.helpNotLoaded, () => {
      this.#help = null;
    });
  }

  #openEvents(): void {
    this.#events ??= import('./events-dialog.ts').then(({ eventsDialog }) =>
      eventsDialog(this.#parts.state.events),
    );
    this.#open(this.#events, guideWords.eventsNotLoaded, () => {
      this.#events = null;
    });
  }

  #open(loading: Promise<HTMLDialogElement>, fault: string, onFault: () => void): void {
    loading.then(
      (dialog) => {
        this.#parts.inputs.releaseAll();
        openDialog(dialog);
      },
      (error: unknown) => {
        console.error(error);
        onFault();
        this.#parts.state.notices.tell(fault, 'warning');
      },
    );
  }

  #startTour(): void {
    this.#endTour?.();
    this.#endTour = null;
    if (this.#loadingTour) return;
    this.#loadingTour = true;
    const { client, state, inputs } = this.#parts;
    import('./tour-panel.ts').then(
      ({ showTour }) => {
        this.#loadingTour = false;
        this.#endTour = showTour({
          ...{ client, state, settings: inputs.settings, mayTour: this.#mayTour },
          onEnd: () => {
            this.#endTour?.();
            this.#endTour = null;
            rememberTour();
          },
        });
      },
      (error: unknown) => {
        console.error(error);
        this.#loadingTour = false;
        state.notices.tell(guideWords.tourNotLoaded, 'warning');
      },
    );
  }
}
