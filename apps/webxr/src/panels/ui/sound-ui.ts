/** The switch for the robot's sound with its volume and meter, and the button that is held to speak. */
import type { RobotClient, VoiceFailure } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { SoundState } from '../../state/sound-state.ts';
import type { SoundPlayer } from '../../take/sound/sound-player.ts';
import { texts } from '../../words/language.ts';
import type { Words } from '../../words/words.ts';
import { elements } from './elements.ts';
import { type TalkControl, TalkHold } from './operator-inputs.ts';
import { quietButton, sliderOf } from './panel-parts.ts';

/** How often the meter is drawn, ms: shorter than its window of sound (sound-player.ts). */
const METER_MS = 100;

export interface SoundUiParts {
  readonly client: RobotClient;
  readonly state: SoundState;
  readonly player: SoundPlayer;
  /** Shows a line that disappears by itself. */
  tell(words: Words): void;
}

export class SoundUi {
  readonly #parts: SoundUiParts;
  readonly #talk = new TalkHold();

  constructor(parts: SoundUiParts) {
    this.#parts = parts;
  }

  start(): void {
    const { client, state, player, tell } = this.#parts;
    client.on('session', () => player.use(null));
    client.on('soundTrack', (track) => player.use(track));
    player.onRefused = (detail) => {
      console.info('sound:', detail);
      state.refused.value = detail;
    };
    let told: VoiceFailure | null = null;
    client.on('voice', ({ failure }) => {
      if (failure === null || failure === told) return;
      told = failure;
      console.info('microphone:', failure.detail);
      tell({ text: texts().media.voiceFailures[failure.reason], tone: 'warning' });
    });
    this.#showPanel();
    this.#startButton();
    effect(() => {
      player.volume = state.volume.value;
    });
    effect(() => {
      if (!state.wanted.value || !state.hasMicrophone.value) return;
      const measure = () => {
        state.playing.value = player.playing;
        state.level.value = player.level();
      };
      const timer = setInterval(measure, METER_MS);
      return () => {
        clearInterval(timer);
        state.playing.value = false;
        state.level.value = 0;
      };
    });
  }

  /** A control with which the operator speaks was pressed or let go. */
  hold(control: TalkControl, down: boolean): void {
    const { sound } = this.#parts.client;
    if (this.#talk.set(control, down)) sound.press();
    else sound.release();
  }

  /** In the handler of a click, because browsers begin to play in one only. */
  #toggle(): void {
    const { client, state, player } = this.#parts;
    const on = !state.wanted.peek();
    state.wanted.value = on;
    state.refused.value = null;
    if (on) player.start();
    else player.stop();
    client.sound.listen(on);
  }

  #showPanel(): void {
    const { state } = this.#parts;
    const said = texts().media;
    const button = quietButton(said.sound, said.soundTitle, () => this.#toggle());
    const scale = { min: 0, max: 1, step: 0.05 };
    const slider = sliderOf(said.volume, scale, (value) => {
      state.volume.value = value;
    });
    slider.value = String(state.volume.peek());
    const meter = document.createElement('span');
    meter.className = 'level';
    meter.ariaHidden = 'true';
    const line = document.createElement('span');
    line.className = 'state';
    line.role = 'status';
    elements.sound.replaceChildren(button, slider, meter, line);
    effect(() => {
      elements.sound.hidden = !state.hasMicrophone.value;
    });
    effect(() => {
      const on = state.wanted.value;
      button.ariaPressed = String(on);
      slider.hidden = meter.hidden = !on;
    });
    effect(() => {
      const { text, tone, state: is } = state.heard.value;
      line.textContent = text;
      line.dataset.tone = tone;
      elements.sound.dataset.state = is;
    });
    effect(() => meter.style.setProperty('--level', state.level.value.toFixed(2)));
  }

  #startButton(): void {
    const { state } = this.#parts;
    const { talk, talkState } = elements;
    talk.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      talk.setPointerCapture(event.pointerId);
      this.hold('pointer', true);
    });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      talk.addEventListener(end, () => this.hold('pointer', false));
    }
    // The space bar remains the drive grip, and a long touch must not open a menu.
    talk.addEventListener('mousedown', (event) => event.preventDefault());
    talk.addEventListener('contextmenu', (event) => event.preventDefault());
    effect(() => {
      talk.hidden = !state.hasLoudspeaker.value;
    });
    effect(() => {
      const { text, tone, state: is } = state.said.value;
      talk.dataset.state = is;
      talkState.hidden = text === '' || !state.hasLoudspeaker.value;
      talkState.textContent = text;
      talkState.dataset.tone = tone;
    });
    effect(() => {
      talk.ariaPressed = String(state.voice.value.held);
    });
  }
}
