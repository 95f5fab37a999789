/** The tile with where the time goes: the clouds' stages as a bar, latency tests and their stages, and their export. */
import type { FrameStages, Telemetry } from '@farpoint/operator';
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { cloudStages } from '../latency/cloud-stages.ts';
import { latencyCsv } from '../latency/latency-csv.ts';
import type { LatencyEntry, LatencyLog } from '../latency/latency-log.ts';
import {
  cloudStageWords,
  frameTotalWords,
  lastTestWords,
  networkWords,
  type StageWords,
  testStageWords,
  testsWords,
} from '../status/latency-words.ts';
import type { PageStats } from '../status/page-stats.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { saveFile } from '../ui/save-file.ts';
import { part, setText, type Tile } from './tile.ts';

export interface LatencyTileSources {
  readonly latency: LatencyLog;
  readonly figures: ReadonlySignal<PageStats>;
  readonly telemetry: ReadonlySignal<Telemetry | null>;
  /** Something has come from the robot just now. */
  readonly heard: ReadonlySignal<boolean>;
}

const UPDATE_MS = 250;
/** Without a frame for so long the stages are not those of now, ms. */
const STILL_MS = 1000;

export function latencyTile({ latency, figures, heard, telemetry }: LatencyTileSources): Tile {
  const element = part('latency');
  const total = part('total', 'p');
  const frameBar = new StageBar();
  const network = part('network', 'p');
  const last = part('last', 'p');
  const testBar = new StageBar();
  const tests = part('tests', 'p');
  const once = quietButton('Test', 'Measure motion to photon once (L)', () => {
    // What went wrong is kept, and said below.
    latency.once(performance.now()).catch(() => undefined);
  });
  const many = quietButton('', 'Measure motion to photon again and again', () => {
    if (latency.continuous.peek()) latency.abort();
    else latency.start();
  });
  const save = quietButton('CSV', 'Save all latency tests as a table', () =>
    saveFile('latency', 'csv', new Blob([latencyCsv(latency.entries.peek())], { type: 'text/csv' })),
  );
  const buttons = part('buttons');
  buttons.append(once, many, save);
  element.append(total, frameBar.element, network, buttons, last, testBar.element, tests);
  const dispose = effect(() => {
    const entries = latency.entries.value;
    const isOn = latency.continuous.value;
    setText(many, isOn ? 'Abort' : 'Continuous');
    many.ariaPressed = String(isOn);
    once.disabled = isOn;
    save.disabled = entries.length === 0;
    const entry: LatencyEntry | undefined = entries.at(-1);
    setText(last, lastTestWords(entry));
    testBar.show(testStageWords(entry?.stages ?? null));
    testBar.element.hidden = entry?.report == null;
    setText(tests, testsWords(entries));
  });
  let seen = -1;
  let seenMs = Number.NEGATIVE_INFINITY;
  return {
    element,
    everyMs: () => UPDATE_MS,
    update({ nowMs }) {
      const { frameStages, minRttMs, decodeUs, sensors } = figures.peek();
      if (frameStages !== null && frameStages.framesSeen !== seen) {
        seen = frameStages.framesSeen;
        seenMs = nowMs;
      }
      const isHeard = heard.peek();
      const live: FrameStages | null = isHeard && nowMs - seenMs < STILL_MS ? frameStages : null;
      element.dataset.stale = String(live === null);
      setText(total, frameTotalWords(live));
      const robot = sensors.length > 1 ? null : (telemetry.peek()?.stages ?? null);
      frameBar.show(cloudStageWords(live === null ? null : cloudStages(live, robot, decodeUs)));
      setText(network, networkWords(isHeard ? minRttMs : null));
    },
    dispose: () => {
      dispose();
      // Nobody could see it go on, nor end it.
      latency.abort();
    },
  };
}

/** Parts side by side, as wide as they take time, and below them what each is. */
class StageBar {
  readonly element = part('stages');
  readonly #bar = part('bar');
  readonly #names = document.createElement('ul');

  constructor() {
    this.#bar.ariaHidden = 'true';
    this.element.append(this.#bar, this.#names);
  }

  show(stages: readonly StageWords[]): void {
    while (this.#names.children.length < stages.length) {
      this.#bar.append(part('', 'span'));
      const item = document.createElement('li');
      item.append(part('name', 'span'), part('ms', 'output'));
      this.#names.append(item);
    }
    stages.forEach(({ name, ms, text }, i) => {
      const [shownName, shownMs] = [...(this.#names.children[i]?.children ?? [])] as [
        HTMLElement,
        HTMLElement,
      ];
      // Read aloud on request only.
      shownMs.ariaLive = 'off';
      setText(shownName, name);
      setText(shownMs, text);
      (this.#bar.children[i] as HTMLElement).style.flexGrow = String(Math.max(ms ?? 0, 0));
    });
  }
}
