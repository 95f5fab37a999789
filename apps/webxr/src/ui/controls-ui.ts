/** Maps buttons, mouse, wheel and keys to actions. */
import { LatencyError, type RobotClient } from '@farpoint/operator';
import { computed, effect } from '@preact/signals-core';
import type { LiveSettings } from '../live-settings.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import type { PageState } from '../state/page-state.ts';
import { hazardNotice } from '../status/hazard-words.ts';
import { speedShareWords } from '../status/input-words.ts';
import { latencyFailureWords, latencyResultWords } from '../status/latency-words.ts';
import { predictionWords } from '../status/view-words.ts';
import type { FrameLoop } from '../view/frame-loop.ts';
import type { PredictedView } from '../view/predicted-view.ts';
import type { Stage } from '../view/stage.ts';
import type { HeadsetMode, VrSession } from '../view/vr-session.ts';
import { ClipUi } from './clip-ui.ts';
import { elements } from './elements.ts';
import type { EstopUi } from './estop-ui.ts';
import { GuideUi } from './guide-ui.ts';
import { InputsDialog } from './inputs-dialog.ts';
import { startLook } from './look-controls.ts';
import type { Action, OperatorInputs } from './operator-inputs.ts';
import { saveScene } from './save-scene.ts';
import { initSettingsDialog } from './settings-dialog.ts';

/** What the controls act on. */
export interface Controlled {
  readonly client: RobotClient;
  readonly state: PageState;
  readonly appearance: CloudAppearance;
  readonly inputs: OperatorInputs;
  readonly stage: Pick<Stage, 'look' | 'camera'>;
  readonly vr: VrSession;
  /** Shows the next view in the headset. */
  nextHeadsetView(): void;
  readonly estop: EstopUi;
  readonly predicted: Pick<PredictedView, 'on'>;
  choose(robotId: string): void;
  /** Whether the next click on the floor sends the robot there, or no longer. */
  toggleGoTo(): void;
  /** Opens or closes the dashboard. */
  toggleDashboard(): void;
  readonly settings: Pick<LiveSettings, 'apply' | 'clips' | 'tour'>;
  frames(): Pick<FrameLoop, 'afterNextFrame'>;
}

export class ControlsUi {
  readonly #parts: Controlled;
  readonly #guide: GuideUi;
  readonly #clips: ClipUi;

  constructor(parts: Controlled) {
    this.#parts = parts;
    this.#guide = new GuideUi({
      ...parts,
      tour: parts.settings.tour,
      inVr: parts.vr.active,
      saveScene: () => this.act('save-scene', performance.now()),
      saveClip: () => this.#clips.save(),
    });
    this.#clips = new ClipUi({ ...parts, canvas: elements.stage, inVr: parts.vr.active });
  }

  start(): void {
    const { client, state, estop, settings } = this.#parts;
    elements.disconnect.addEventListener('click', () => client.leave());
    estop.start();
    elements.latency.addEventListener('click', ({ timeStamp }) => this.act('latency-test', timeStamp));
    elements.view.addEventListener('click', () => this.act('view', performance.now()));
    elements.take.addEventListener('click', () => client.takeOver());
    elements.release.addEventListener('click', () => client.driver.releaseLease());
    // After a click, the space bar is the drive grip again. Who presses a button by a key keeps the place.
    for (const button of document.querySelectorAll<HTMLButtonElement>('#bar button, #drive button')) {
      button.addEventListener('click', ({ detail }) => {
        if (detail > 0) button.blur();
      });
    }
    initSettingsDialog(state.pointScale, settings);
    const watches = computed(() => state.driving.role.value === 'watch');
    new InputsDialog({ inputs: this.#parts.inputs, maxLinear: state.robot.maxLinear, watches }).start();
    this.#guide.start();
    this.#clips.start();
    this.#startVr();
    startLook(elements.stage, this.#parts.stage);
  }

  act(action: Action, timeMs: number): void {
    const { stage, estop, appearance, vr } = this.#parts;
    const inVr = vr.active.peek();
    const { fromAbove } = appearance;
    switch (action) {
      case 'estop':
        estop.stop();
        return;
      case 'latency-test':
        this.#testLatency(timeMs);
        return;
      case 'recentre':
        if (inVr) vr.recentre();
        else stage.look.recentre();
        return;
      case 'view':
        if (inVr) this.#parts.nextHeadsetView();
        // From above, it returns to the view from before.
        else if (fromAbove.peek()) fromAbove.value = false;
        else stage.look.switchMode();
        return;
      case 'from-above':
        fromAbove.value = !fromAbove.peek();
        return;
      case 'hazards':
        this.#toggleHazards();
        return;
      case 'enlarge':
        this.#parts.state.enlarged.next();
        return;
      case 'dashboard':
        this.#parts.toggleDashboard();
        return;
      case 'predict':
        this.#togglePrediction();
        return;
      case 'go-to':
        this.#parts.toggleGoTo();
        return;
      case 'swap':
        this.#parts.state.swap();
        return;
      case 'faster':
      case 'slower':
        this.#shift(action);
        return;
      case 'next-robot':
        this.#nextRobot();
        return;
      case 'save-scene':
        saveScene({ canvas: elements.stage, frames: this.#parts.frames(), state: this.#parts.state, inVr });
        return;
      case 'save-clip':
        this.#clips.save();
        return;
      case 'help':
        this.#guide.openHelp();
    }
  }

  #shift(gear: 'faster' | 'slower'): void {
    const { inputs, state } = this.#parts;
    const { speed } = inputs.settings;
    speed[gear]();
    const words = speedShareWords(speed.share.peek(), state.robot.maxLinear.peek());
    state.notices.tell(`Greatest speed: ${words}`);
  }

  #testLatency(startedAtMs: number): void {
    const { state } = this.#parts;
    state.latency.once(startedAtMs).then(
      (report) => state.notices.tell(latencyResultWords(report), 'good'),
      (error: unknown) => {
        if (!(error instanceof LatencyError)) throw error;
        state.notices.tell(latencyFailureWords[error.reason], 'warning');
      },
    );
  }

  #togglePrediction(): void {
    const { predicted, state } = this.#parts;
    predicted.on.value = !predicted.on.peek();
    state.notices.tell(predictionWords(predicted.on.peek()));
    state.sample();
  }

  #toggleHazards(): void {
    const { appearance, state } = this.#parts;
    const { hazards } = appearance;
    hazards.value = !hazards.peek();
    state.notices.tell(hazardNotice(hazards.peek(), state.robot.heights.peek()));
  }

  #nextRobot(): void {
    const { link, notices } = this.#parts.state;
    if (link.chosenRobotId.value === null) return;
    const next = link.nextRobot.value;
    if (next === null) notices.tell('No other robot is available.');
    else this.#parts.choose(next.id);
  }

  #startVr(): void {
    const { vr, state } = this.#parts;
    effect(() => {
      const reason = vr.unavailable.value;
      elements.vr.hidden = reason !== null;
      elements.vrReason.hidden = reason === null || reason === undefined;
      elements.vrReason.textContent = reason ?? null;
    });
    effect(() => {
      const isLeaving = vr.active.value;
      elements.vr.textContent = isLeaving ? `Leave ${vr.passthrough.value ? 'AR' : 'VR'}` : 'Enter VR';
      elements.ar.hidden = isLeaving || !vr.canPassThrough.value;
    });
    const enter = (mode: HeadsetMode, name: string) => {
      vr.toggle(mode).catch((error: unknown) => {
        state.notices.tell(
          `Could not enter ${name}: ${error instanceof Error ? error.message : error}`,
          'bad',
        );
      });
    };
    elements.vr.addEventListener('click', () => enter('immersive-vr', 'VR'));
    elements.ar.addEventListener('click', () => enter('immersive-ar', 'AR'));
  }
}
