/** The first drive on the screen: what to do now, until it has been seen. Loaded when it is first shown. */
import './tour.css';
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, signal } from '@preact/signals-core';
import type { InputSettings } from '../drive/input-settings.ts';
import type { PageState } from '../state/page-state.ts';
import { tourLine, tourWords } from '../status/tour-words.ts';
import { type DriveFacts, FirstDrive } from '../tour/first-drive.ts';
import { elements } from './elements.ts';
import { quietButton } from './panel-parts.ts';
import { textOf } from './sheet-parts.ts';

/** Slower than this the robot may be standing: m/s, and rad/s. */
const LEAST_MOTION = 0.03;

export interface TourParts {
  readonly client: RobotClient;
  readonly state: PageState;
  readonly settings: InputSettings;
  /** Whether there is a robot that this operator may drive, and a screen to read this on. */
  readonly mayTour: ReadonlySignal<boolean>;
  /** It is over. */
  onEnd(): void;
}

/** Shows the first drive from its beginning. @returns takes it away */
export function showTour(parts: TourParts): () => void {
  const { mayTour } = parts;
  const tour = new FirstDrive();
  const panel = document.createElement('section');
  panel.id = 'tour';
  panel.ariaLabel = tourWords.title;
  const text = textOf('p', '');
  text.role = 'status';
  const skip = quietButton(tourWords.skip, tourWords.skip, () => tour.skip());
  const end = quietButton(tourWords.end, '', () => parts.onEnd());
  const buttons = textOf('div', '', 'menu');
  buttons.append(skip, end);
  panel.append(text, buttons);
  // In the order of the page: after the bar, before everything else.
  elements.bar.after(panel);
  const facts = driveFacts(parts);
  const stopSeeing = effect(() => {
    if (mayTour.value) tour.see(facts.value);
  });
  const line = lineOf(parts, tour);
  // What a status says when it appears is not read aloud: only what it says later.
  const isThere = signal(false);
  requestAnimationFrame(() => {
    isThere.value = true;
  });
  const stopShowing = effect(() => {
    const isDone = tour.step.value === 'done';
    panel.hidden = !mayTour.value;
    skip.hidden = isDone;
    end.textContent = isDone ? tourWords.close : tourWords.end;
    // A line that is the same is not read aloud again.
    if (isThere.value && text.textContent !== line.value) text.textContent = line.value;
  });
  return () => {
    stopSeeing();
    stopShowing();
    panel.remove();
  };
}

function driveFacts({ client, state }: TourParts): ReadonlySignal<DriveFacts> {
  const { driving, robot, sampledAtMs } = state;
  return computed(() => {
    // What follows is read anew with each sample.
    void sampledAtMs.value;
    const twist = robot.telemetry.value?.twist;
    const speed = twist === undefined ? 0 : Math.hypot(twist.linear.x, twist.linear.y, twist.angular.z);
    const isYours = client.link.session.estopCause?.yours ?? robot.stop.value === 'confirmed';
    return {
      holds: driving.gripped.value && driving.holder.value === 'you',
      moves: robot.heard.value && speed >= LEAST_MOTION,
      stop: robot.latchedStop.value === null ? 'off' : isYours ? 'yours' : 'other',
    };
  });
}

function lineOf({ state, settings }: TourParts, tour: FirstDrive): ReadonlySignal<string> {
  const { driving, robot } = state;
  return computed(() => {
    const motion = robot.motion.value;
    return tourLine(tour.step.value, {
      ...{ keys: settings.keys.value, oneHanded: settings.oneHanded.value },
      touch: window.matchMedia('(hover: none)').matches,
      otherDrives: driving.holder.value === 'other',
      stop: robot.latchedStop.value,
      heldBy: driving.gripped.value && motion?.tone === 'bad' ? motion.text : null,
    });
  });
}
