/** Keeps the last 30 seconds of the scene if the operator wants that, and saves them as a file. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { ClipRecorder } from '../clip/clip-recorder.ts';
import type { LiveSettings } from '../live-settings.ts';
import type { PageState } from '../state/page-state.ts';
import { clipWords } from '../status/clip-words.ts';
import type { FrameLoop } from '../view/frame-loop.ts';
import { saveFile } from './save-file.ts';

export interface ClipParts {
  readonly canvas: HTMLCanvasElement;
  readonly state: Pick<PageState, 'link' | 'notices'>;
  readonly settings: Pick<LiveSettings, 'clips'>;
  readonly inVr: ReadonlySignal<boolean>;
  frames(): Pick<FrameLoop, 'afterNextFrame'>;
}

export class ClipUi {
  readonly #parts: ClipParts;
  #recorder: ClipRecorder | null = null;
  /** Counts switching on and off: what was loading for an earlier state is not used. */
  #turn = 0;
  #isSaving = false;

  constructor(parts: ClipParts) {
    this.#parts = parts;
  }

  start(): void {
    const { settings, inVr } = this.#parts;
    effect(() => {
      // In the headset, the canvas shows nothing.
      const wanted = settings.clips && !inVr.value;
      this.#turn++;
      this.#stop();
      if (wanted) void this.#record(this.#turn);
    });
  }

  save(): void {
    const { settings, inVr, state } = this.#parts;
    if (inVr.peek()) state.notices.tell(clipWords.inVr);
    else if (!settings.clips) state.notices.tell(clipWords.off);
    else if (this.#recorder === null) this.#tellNothing();
    else if (!this.#isSaving) void this.#save(this.#recorder);
  }

  async #record(turn: number): Promise<void> {
    const { canvas, frames, state } = this.#parts;
    if (typeof VideoEncoder === 'undefined') return;
    try {
      const { ClipRecorder } = await import('../clip/clip-recorder.ts');
      if (turn !== this.#turn) return;
      const recorder = new ClipRecorder({
        canvas,
        afterNextFrame: (act) => frames().afterNextFrame(act),
        caption: () => {
          const { chosenRobotId, live } = state.link;
          return clipWords.caption(new Date().toLocaleString(), chosenRobotId.peek(), live.peek());
        },
      });
      recorder.onFailure = (detail) => {
        if (turn !== this.#turn) return;
        this.#stop();
        state.notices.tell(clipWords.stopped(detail), 'warning');
      };
      this.#recorder = recorder;
    } catch (error) {
      state.notices.tell(clipWords.stopped(messageOf(error)), 'warning');
    }
  }

  async #save(recorder: ClipRecorder): Promise<void> {
    const { notices } = this.#parts.state;
    this.#isSaving = true;
    try {
      const clip = await recorder.clip();
      const [first, last] = [clip.pictures[0], clip.pictures.at(-1)];
      if (first === undefined || last === undefined) {
        this.#tellNothing();
        return;
      }
      const { clipFile } = await import('../clip/clip-file.ts');
      saveFile('clip', 'webm', await clipFile(clip));
      notices.tell(clipWords.saved((last.timestampUs - first.timestampUs) / 1e6));
    } catch (error) {
      console.error(error);
      notices.tell(clipWords.failed, 'warning');
    } finally {
      this.#isSaving = false;
    }
  }

  #tellNothing(): void {
    const canCode = typeof VideoEncoder !== 'undefined';
    this.#parts.state.notices.tell(canCode ? clipWords.nothingYet : clipWords.unavailable);
  }

  #stop(): void {
    this.#recorder?.close();
    this.#recorder = null;
  }
}

function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
