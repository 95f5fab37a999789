/** Maps buttons, mouse, wheel and keys to actions. */
import { LatencyError, type RobotClient } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { LiveSettings } from '../../ground/live-settings.ts';
import type { PredictedView } from '../../scene/view/predicted-view.ts';
import type { Stage } from '../../scene/view/stage.ts';
import type { HeadsetMode, VrSession } from '../../scene/view/vr-session.ts';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import type { PageState } from '../../state/page-state.ts';
import type { Action } from '../../take/drive/key-map.ts';
import { inputSettings } from '../../take/drive/stored-inputs.ts';
import { ms } from '../../words/facts.ts';
import { hazardNotice } from '../../words/hazard-words.ts';
import { speedShareWords } from '../../words/input-words.ts';
import { texts } from '../../words/language.ts';
import { predictionWords } from '../../words/view-words.ts';
import { addBookmark } from './commands-panel.ts';
import { elements } from './elements.ts';
import type { EstopUi } from './estop-ui.ts';
import { startLook } from './look-controls.ts';

import { initSettingsDialog } from './settings-dialog.ts';

/** What the controls act on. */
export interface Controlled {
  readonly client: RobotClient;
  readonly state: PageState;
  readonly appearance: CloudAppearance;
  readonly stage: Pick<Stage, 'look' | 'camera'>;
  readonly vr: VrSession;
  /** Shows the next view in the headset. */
  nextHeadsetView(): void;
  readonly estop: EstopUi;
  readonly predicted: Pick<PredictedView, 'on'>;
  readonly settings: Pick<LiveSettings, 'apply'>;
  choose(robotId: string): void;
  /** Points at the floor under the mouse, for the other operators. */
  point(): void;
  /** Opens or closes the dashboard. */
  toggleDashboard(): void;
  /** Opens the event log. */
  openEvents(): void;
  /** Saves a picture of the view, and a clip of the last 30 s. */
  readonly capture: { picture(): void; clip(): void };
  /** Opens or closes the help. */
  toggleHelp(): void;
}

export class ControlsUi {
  readonly #parts: Controlled;

  constructor(parts: Controlled) {
    this.#parts = parts;
  }

  start(): void {
    const { client, state, estop } = this.#parts;
    elements.disconnect.addEventListener('click', () => client.leave());
    estop.start();
    elements.latency.addEventListener('click', ({ timeStamp }) => this.act('latency-test', timeStamp));
    elements.view.addEventListener('click', () => this.act('view', performance.now()));
    elements.take.addEventListener('click', () => client.takeOver());
    // A button that kept the focus would take the space bar, which is the drive grip.
    for (const button of document.querySelectorAll<HTMLButtonElement>('#bar button, #drive button')) {
      button.addEventListener('click', () => button.blur());
    }
    initSettingsDialog(state.pointScale, this.#parts.settings);
    this.#startVr();
    startLook(elements.stage, this.#parts.stage);
  }

  act(action: Action, timeMs: number): void {
    this.#actions[action](timeMs);
  }

  /** @param timeMs of the event that asks for it */
  readonly #actions: Readonly<Record<Action, (timeMs: number) => void>> = {
    estop: () => this.#parts.estop.stop(),
    'latency-test': (timeMs) => this.#testLatency(timeMs),
    recentre: () => this.#recentre(),
    view: () => this.#nextView(),
    'from-above': () => {
      const { fromAbove } = this.#parts.appearance;
      fromAbove.value = !fromAbove.peek();
    },
    hazards: () => this.#toggleHazards(),
    enlarge: () => this.#parts.state.enlarged.next(),
    dashboard: () => this.#parts.toggleDashboard(),
    events: () => this.#parts.openEvents(),
    picture: () => this.#parts.capture.picture(),
    clip: () => this.#parts.capture.clip(),
    predict: () => this.#togglePrediction(),
    swap: () => this.#parts.state.swap(),
    bookmark: () => addBookmark(this.#parts.state.commands),
    'next-robot': () => this.#nextRobot(),
    faster: () => this.#shift('faster'),
    slower: () => this.#shift('slower'),
    point: () => this.#parts.point(),
    help: () => this.#parts.toggleHelp(),
  };

  #recentre(): void {
    const { vr, stage } = this.#parts;
    if (vr.active.peek()) vr.recentre();
    else stage.look.recentre();
  }

  #nextView(): void {
    const { vr, stage, appearance } = this.#parts;
    const { fromAbove } = appearance;
    if (vr.active.peek()) this.#parts.nextHeadsetView();
    // From above, it returns to the view from before.
    else if (fromAbove.peek()) fromAbove.value = false;
    else stage.look.switchMode();
  }

  #testLatency(startedAtMs: number): void {
    const { client, state } = this.#parts;
    client.latencyTest(startedAtMs).then(
      ({ mtpMs, firstMs }) => {
        state.notices.tell(texts().timing.result(ms(mtpMs), ms(firstMs)), 'good');
      },
      (error: unknown) => {
        if (!(error instanceof LatencyError)) throw error;
        state.notices.tell(texts().timing.failureNotices[error.reason], 'warning');
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

  #shift(way: 'faster' | 'slower'): void {
    const { notices, robot } = this.#parts.state;
    const { speed } = inputSettings;
    speed[way]();
    notices.tell(
      texts().inputs.speedNotice(speedShareWords(speed.share.peek(), robot.maxLinear.peek())),
      'neutral',
    );
  }

  #nextRobot(): void {
    const { link, notices } = this.#parts.state;
    const next = link.nextRobot.value;
    if (next === null) notices.tell(texts().driving.noOtherRobot);
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
      const { leave, enterVr } = texts().headset;
      elements.vr.textContent = isLeaving ? leave(vr.passthrough.value ? 'AR' : 'VR') : enterVr;
      elements.ar.hidden = isLeaving || !vr.canPassThrough.value;
    });
    const enter = (mode: HeadsetMode, name: string) => {
      vr.toggle(mode).catch((error: unknown) => {
        const why = error instanceof Error ? error.message : String(error);
        state.notices.tell(texts().headset.couldNotEnter(name, why), 'bad');
      });
    };
    elements.vr.addEventListener('click', () => enter('immersive-vr', 'VR'));
    elements.ar.addEventListener('click', () => enter('immersive-ar', 'AR'));
  }
}
