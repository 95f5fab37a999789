/** Saves a picture of the view, and, where the operator wants that, keeps the last 30 seconds of it as a clip. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { pictureSize } from '../../ground/capture/picture-size.ts';
import type { EventDetail } from '../../ground/events/page-event.ts';
import type { LiveSettings } from '../../ground/live-settings.ts';
import type { PageState } from '../../state/page-state.ts';
import { captionLines } from '../../words/capture-words.ts';
import { texts } from '../../words/language.ts';
import { elements } from '../ui/elements.ts';
import { saveFile } from '../ui/save-file.ts';
import type { ClipRecorder } from './clip-recorder.ts';
import { paintView, viewSize } from './view-painter.ts';

/** Longest side of a picture, pixels. Chosen: a 4K screen as it is. */
const MOST_SIDE = 3840;

export interface CaptureParts {
  readonly state: Pick<PageState, 'link' | 'robot' | 'notices'>;
  readonly settings: Pick<LiveSettings, 'clips'>;
  readonly inVr: ReadonlySignal<boolean>;
  /** Calls `act` once, in the next display frame, after the scene is drawn and before it is shown. */
  afterNextFrame(act: () => void): void;
}

export class CaptureUi {
  /** Called for the event log. */
  onSaved: ((detail: EventDetail) => void) | null = null;
  readonly #parts: CaptureParts;
  #recorder: ClipRecorder | null = null;
  /** Counts switching on and off: what was loading for an earlier state is not used. */
  #turn = 0;
  #isSaving = false;

  constructor(parts: CaptureParts) {
    this.#parts = parts;
  }

  /** Keeps clips from now on, while the settings want them. */
  start(): void {
    const { settings, inVr } = this.#parts;
    effect(() => {
      // In the headset the page's own view stands still.
      const isWanted = settings.clips && !inVr.value;
      this.#turn++;
      this.#stop();
      if (isWanted) void this.#record(this.#turn);
    });
  }

  /** Saves a picture of what is seen. */
  picture(): void {
    const { state, inVr, afterNextFrame } = this.#parts;
    if (inVr.peek()) {
      state.notices.tell(texts().capture.inVr);
      return;
    }
    afterNextFrame(() => {
      const { width, height } = pictureSize(viewSize(), MOST_SIDE);
      const sheet = new OffscreenCanvas(width, height);
      const context = sheet.getContext('2d', { alpha: false });
      if (context !== null) paintView(context, sheet, this.#caption());
      sheet.convertToBlob({ type: 'image/png' }).then(
        (content) => {
          saveFile('picture', 'png', content);
          state.notices.tell(texts().capture.pictureSaved, 'good');
          this.onSaved?.({ kind: 'picture-saved' });
        },
        (error: unknown) => {
          console.error(error);
          state.notices.tell(texts().capture.pictureFailed, 'warning');
        },
      );
    });
  }

  /** Saves what has been kept. */
  clip(): void {
    const { settings, inVr, state } = this.#parts;
    const said = texts().capture;
    if (inVr.peek()) state.notices.tell(said.inVr);
    else if (!settings.clips) state.notices.tell(said.clipsOff);
    else if (this.#recorder === null) this.#tellNothing();
    else if (!this.#isSaving) void this.#save(this.#recorder);
  }

  #caption(): readonly string[] {
    const { link, robot } = this.#parts.state;
    return captionLines({
      epochMs: Date.now(),
      robot: robot.name.peek() ?? link.chosenRobotId.peek(),
      heard: link.live.peek() && link.heard.peek(),
      stopped: robot.estopLatched.peek(),
      figures: elements.factsFold.textContent ?? '',
    });
  }

  async #record(turn: number): Promise<void> {
    const { afterNextFrame, state } = this.#parts;
    if (typeof VideoEncoder === 'undefined') return;
    const fail = (error: unknown) => {
      if (turn !== this.#turn) return;
      this.#stop();
      const detail = error instanceof Error ? error.message : String(error);
      state.notices.tell(texts().capture.clipStopped(detail), 'warning');
    };
    try {
      const { ClipRecorder } = await import('./clip-recorder.ts');
      if (turn !== this.#turn) return;
      this.#recorder = new ClipRecorder({ afterNextFrame, caption: () => this.#caption() });
      this.#recorder.onFailure = fail;
    } catch (error) {
      fail(error);
    }
  }

  async #save(recorder: ClipRecorder): Promise<void> {
    const { notices } = this.#parts.state;
    this.#isSaving = true;
    try {
      const clip = await recorder.clip();
      if (clip.pictures.length === 0) {
        this.#tellNothing();
        return;
      }
      const { clipFile } = await import('./clip-file.ts');
      const { content, seconds, missingS } = await clipFile(clip);
      saveFile('clip', 'webm', content);
      notices.tell(texts().capture.clipSaved(Math.round(seconds), Math.round(missingS)), 'good');
      this.onSaved?.({ kind: 'clip-saved', seconds });
    } catch (error) {
      console.error(error);
      notices.tell(texts().capture.clipFailed, 'warning');
    } finally {
      this.#isSaving = false;
    }
  }

  #tellNothing(): void {
    const said = texts().capture;
    const canEncode = typeof VideoEncoder !== 'undefined';
    this.#parts.state.notices.tell(canEncode ? said.clipEmpty : said.clipUnavailable);
  }

  #stop(): void {
    this.#recorder?.close();
    this.#recorder = null;
  }
}
