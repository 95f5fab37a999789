/** The first drive on the screen: what to do now, until the page sees that it was done. Its code is loaded when it is first shown. */
import './tour.css';
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, signal } from '@preact/signals-core';
import { type DriveFacts, FirstDrive } from '../../state/first-drive.ts';
import type { PageState } from '../../state/page-state.ts';
import { missingOf } from '../../take/drive/controller-map.ts';
import type { InputSettings } from '../../take/drive/input-settings.ts';
import { laterTexts } from '../../words/language.ts';
import { type TourFacts, tourLine } from '../../words/tour-words.ts';
import { elements } from '../ui/elements.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { connectedControllers } from './connected-controllers.ts';

/**
 * Below this the robot may be standing: m/s and rad/s together. Chosen: above the noise of odometry at rest, far below the
 * slowest drive; help.page.ts holds that a drive is seen.
 */
const LEAST_MOTION = 0.03;

export interface TourParts {
  readonly client: RobotClient;
  readonly state: PageState;
  readonly settings: InputSettings;
  /** Whether there is a robot to drive, and a screen on which to read this. */
  readonly canTour: ReadonlySignal<boolean>;
  /** The last step was done. */
  onDone(): void;
  /** The operator has ended it. */
  onEnd(): void;
}

/** Shows the first drive from its beginning. @returns takes it away */
export function showTour(parts: TourParts): () => void {
  const tour = new FirstDrive();
  const words = laterTexts().help.tour;
  const panel = document.createElement('section');
  panel.id = 'tour';
  panel.ariaLabel = words.title;
  const text = document.createElement('p');
  text.role = 'status';
  const skip = quietButton(words.skip, '', () => tour.skip());
  const end = quietButton(words.end, '', () => parts.onEnd());
  panel.append(text, skip, end);
  // First in the column of messages: notices stand below it, and never on it.
  elements.banner.before(panel);
  const facts = driveFacts(parts);
  const line = lineOf(parts, tour);
  // Browsers do not read aloud what a status says when it appears, only what it says later.
  const isThere = signal(false);
  requestAnimationFrame(() => {
    isThere.value = true;
  });
  const disposals = [
    effect(() => {
      if (parts.canTour.value) tour.see(facts.value);
    }),
    effect(() => {
      const isDone = tour.step.value === 'done';
      panel.hidden = !parts.canTour.value;
      skip.hidden = isDone;
      end.textContent = isDone ? words.close : words.end;
      if (isDone) parts.onDone();
    }),
    effect(() => {
      // A line that stays the same is not read aloud again.
      if (isThere.value && text.textContent !== line.value) text.textContent = line.value;
    }),
  ];
  return () => {
    for (const dispose of disposals) dispose();
    panel.remove();
  };
}

function driveFacts({ client, state }: TourParts): ReadonlySignal<DriveFacts> {
  const { driving, robot, link, sampledAtMs } = state;
  return computed(() => {
    // What follows and is no signal is read anew with each sample.
    void sampledAtMs.value;
    const twist = robot.telemetry.value?.twist;
    const speed = twist === undefined ? 0 : Math.hypot(twist.linear.x, twist.linear.y, twist.angular.z);
    const isYours = client.link.session.estopCause?.yours ?? robot.stop.value === 'confirmed';
    return {
      holds: client.driver.stream.held && driving.holder.value === 'you',
      moves: link.heard.value && speed >= LEAST_MOTION,
      stop: robot.latchedStop.value === null ? 'off' : isYours ? 'yours' : 'other',
    };
  });
}

function lineOf({ client, state, settings }: TourParts, tour: FirstDrive): ReadonlySignal<string> {
  const { driving, robot, sampledAtMs } = state;
  return computed(() => {
    void sampledAtMs.value;
    const motion = robot.motion.value;
    const isHeld = client.driver.stream.held && motion?.tone === 'bad';
    const facts: TourFacts = {
      keys: settings.keys.value,
      controller: connectedControllers(settings).find(({ map }) => missingOf(map) === null) ?? null,
      touch: window.matchMedia('(hover: none)').matches,
      watches: driving.role.value === 'watch',
      otherDrives: driving.holder.value === 'other',
      stop: robot.latchedStop.value,
      heldBy: isHeld ? (motion?.text ?? null) : null,
    };
    return tourLine(tour.step.value, facts);
  });
}
