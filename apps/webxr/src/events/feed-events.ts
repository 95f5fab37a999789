/** Writes into the event log what the page's state and notices tell. The sentences are those that the page shows. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, untracked } from '@preact/signals-core';
import type { PageState } from '../state/page-state.ts';
import { recordedWords } from '../status/about-words.ts';
import { alarmEventWords, chosenWords, eventWords, stoppedWords } from '../status/event-words.ts';
import { latencyFailureWords, latencyResultWords } from '../status/latency-words.ts';
import { driveStateWords, signalingWords, stopWords, type Words } from '../status/words.ts';
import { patternOf } from './event-log.ts';

export type FedState = Pick<PageState, 'events' | 'link' | 'robot' | 'driving' | 'notices' | 'latency'>;

export function feedEvents(state: FedState, client: Pick<RobotClient, 'on'>): void {
  const { events, link, robot, driving } = state;
  const about = () => robot.name.peek() ?? link.chosenRobotId.peek();
  const add = (words: Words) => events.add(words, about());
  const mark = (words: Words) => events.mark(words, about());
  events.mark(eventWords.opened, null);
  feedNotices(state, add);

  onChange(link.chosenRobotId, (id, before) => {
    if (id !== null) events.mark(chosenWords(id), id);
    else events.mark(eventWords.left, before);
  });
  onChange(link.ready, (ready) => {
    const { text, tone } = signalingWords[ready ? 'ready' : 'waiting'];
    events.add({ text, tone }, null);
  });
  onChange(
    computed(() => link.live.value && link.banner.value?.urgent === true),
    (silent) => {
      if (silent) mark(eventWords.silent);
      // Otherwise the session is over, and why has been said.
      else if (link.live.peek()) mark(eventWords.back);
    },
  );
  onWords(
    computed(() => {
      const obstacle = link.obstacle.value;
      return obstacle === null ? null : { text: `${obstacle.title}. ${obstacle.text}`, tone: 'bad' };
    }),
    add,
  );
  onChange(
    computed(() => (link.live.value ? driving.driver.value.text : null)),
    (text, before) => {
      if (text !== null && before !== null) mark(driving.driver.peek());
    },
  );
  onChange(robot.stop, (status) => {
    const words = stopWords[status];
    if (words !== null) mark(words);
  });
  onChange(
    computed(() => robot.latchedStop.value?.why ?? null),
    (why) => {
      if (why !== null) mark(stoppedWords(why));
      else if (link.live.peek()) mark(eventWords.stopOff);
    },
  );
  onWords(robot.motion, add);
  onWords(robot.obstacleGuard, add);
  onWords(
    computed(() => {
      const drive = robot.heard.value ? robot.telemetry.value?.drive : undefined;
      const isNews = drive === 'blocked' || drive === 'watchdog';
      return isNews ? driveStateWords(drive, robot.afterGap.value) : null;
    }),
    add,
  );
  onChange(
    computed(() => robot.about.value?.recorded === true),
    (recorded) => {
      if (recorded) mark({ ...recordedWords, tone: 'warning' });
      else if (link.live.peek()) mark(eventWords.recordingEnded);
    },
  );
  client.on('alarm', (alarm) => add(alarmEventWords(alarm)));
}

/** Notices, and latency tests, of which a notice tells as well if they were asked for one by one. */
function feedNotices({ notices, latency }: FedState, add: (words: Words) => void): void {
  let tested: string | null = null;
  onChange(latency.entries, (entries) => {
    const entry = entries.at(-1);
    if (entry === undefined) return;
    const { report, failure } = entry;
    if (report !== null) tested = latencyResultWords(report);
    else if (failure !== null) tested = latencyFailureWords[failure];
    if (tested !== null) add({ text: tested, tone: report === null ? 'warning' : 'good' });
  });
  onChange(notices.last, (words) => {
    if (words !== null && words.text !== tested) add(words);
    tested = null;
  });
  onChange(notices.failure, (failure) => {
    if (failure !== null) add({ text: `${failure.title}. ${failure.text}`, tone: 'bad' });
  });
}

/** Calls back when the value changes, not for what it is now. */
function onChange<T>(source: ReadonlySignal<T>, act: (now: T, before: T) => void): void {
  let before = source.peek();
  effect(() => {
    const now = source.value;
    if (now === before) return;
    const was = before;
    before = now;
    untracked(() => act(now, was));
  });
}

/** Adds words when they appear, and when others take their place; not when only their numbers change. */
function onWords(source: ReadonlySignal<Words | null>, add: (words: Words) => void): void {
  const pattern = computed(() => patternOf(source.value?.text ?? ''));
  onChange(pattern, () => {
    const words = source.peek();
    if (words !== null) add(words);
  });
}
