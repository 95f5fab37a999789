/** The first drive in four steps. A step ends when the page sees that it was done. */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import { TOUR_STEPS, type TourStep } from '../words/tour-words.ts';

/** What the robot and this operator's hands do now. */
export interface DriveFacts {
  /** Whether this operator's hand holds a grip that drives, and the robot says that this operator drives. */
  readonly holds: boolean;
  /** Whether the robot measures that it moves. */
  readonly moves: boolean;
  /** The emergency stop: off, set by this operator's press, or by anything else. */
  readonly stop: 'off' | 'yours' | 'other';
}

export class FirstDrive {
  readonly #step = signal<TourStep | 'done'>('grip');

  get step(): ReadonlySignal<TourStep | 'done'> {
    return this.#step;
  }

  /** Call it with what is seen, at every change. */
  see(facts: DriveFacts): void {
    const step = this.#step.peek();
    if (step === 'done' || !isDone(step, facts)) return;
    this.#next(step);
    // A single look may show that the next one is done as well.
    this.see(facts);
  }

  /** Goes on without what this step asks for. */
  skip(): void {
    const step = this.#step.peek();
    if (step === 'done') return;
    // What was not stopped cannot be released.
    if (step === 'stop') this.#step.value = 'done';
    else this.#next(step);
  }

  #next(step: TourStep): void {
    this.#step.value = TOUR_STEPS[TOUR_STEPS.indexOf(step) + 1] ?? 'done';
  }
}

function isDone(step: TourStep, { holds, moves, stop }: DriveFacts): boolean {
  switch (step) {
    case 'grip':
      return holds && stop === 'off';
    case 'drive':
      return holds && moves && stop === 'off';
    case 'stop':
      return stop === 'yours';
    case 'release':
      return stop === 'off';
  }
}
