/** The part of the tile with where the time goes that measures motion to photon, once or again and again, as the paper's panel does. */
import { effect } from '@preact/signals-core';
import { texts } from '../../words/language.ts';
import { lastTestWords, latencyCsv, testsWords } from '../../words/latency-words.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { saveTable } from '../ui/save-file.ts';
import { LatencyRuns, type LatencyRunsPort } from './latency-runs.ts';
import { part, setText } from './tile.ts';

export interface LatencyView {
  readonly element: HTMLElement;
  dispose(): void;
}

/** @param test as {@link LatencyRunsPort.test} */
export function latencyView(test: LatencyRunsPort['test']): LatencyView {
  const element = part('latency');
  const runs: LatencyRuns = new LatencyRuns({
    test,
    now: () => performance.now(),
    epochMs: () => Date.now(),
    after: (ms, act) =>
      void setTimeout(() => {
        // Behind a closed dashboard nobody sees why the cloud is green, nor ends it.
        if (element.offsetParent === null) runs.abort();
        else act();
      }, ms),
  });
  const [last, tests] = [part('last', 'p'), part('tests', 'p')];
  const said = texts().timing;
  const single = quietButton(said.single, said.singleTitle, () => void runs.single());
  const continuous = quietButton(said.continuous, said.continuousTitle, () => runs.start());
  const abort = quietButton(said.abort, said.abortTitle, () => runs.abort());
  const save = quietButton(said.testsAsCsv, said.testsAsCsvTitle, () =>
    saveTable('latency', latencyCsv(runs.ends.peek(), runs.distribution())),
  );
  element.append(last, tests, single, continuous, abort, save);
  const forget = effect(() => {
    const ends = runs.ends.value;
    const isOn = runs.continuous.value;
    setText(last, lastTestWords(ends.at(-1)));
    setText(tests, testsWords(ends, runs.distribution()));
    single.disabled = isOn;
    continuous.disabled = isOn;
    abort.disabled = !isOn;
    save.disabled = ends.length === 0;
  });
  return {
    element,
    dispose() {
      forget();
      runs.abort();
    },
  };
}
