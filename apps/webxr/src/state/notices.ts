/** Notices to the operator: a line that disappears by itself, and a failure that keeps the page from working. */

import type { RobotClient } from '@farpoint/operator';
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import { missingGripWords } from '../words/driving-words.ts';
import { handoverEndWords } from '../words/handover-words.ts';
import { texts } from '../words/language.ts';
import { presserWords } from '../words/stop-notices.ts';
import { type Tone, type Words, wordsOfLoss, wordsOfRejection } from '../words/words.ts';
import type { Takeover } from './takeover.ts';

/** Tells people what happens to the session and to their commands, as short notices. The banner tells of a loss. */
export function tellNotices(client: RobotClient, notices: Notices, takeover: Takeover): void {
  const { driver, link } = client;
  // What follows from a takeover must not hide it.
  const isDisplaced = () => takeover.isDisplaced(driver.isGripped);
  client.on('handover', ({ ended, ...handover }) => {
    const { estopCause, operators } = link.session;
    if (ended === undefined) return;
    // Whoever has taken over while its own request was open has what it asked for.
    if (ended === 'driver-changed' && driver.holder === 'you') return;
    const words = handoverEndWords({ ...handover, ended }, presserWords(estopCause, operators));
    if (words !== null) notices.tell(words.text, words.tone);
  });
  // Then no robot is chosen, of which a banner could tell.
  client.on('loss', (loss) => {
    const { maxOperators, lossDetail } = link;
    if (loss === 'ended-by-supervisor')
      notices.tell(wordsOfLoss(loss, { maxOperators, lossDetail }), 'warning');
  });
  client.on('grantExpires', (inS) => notices.tell(texts().link.grantEnds(inS), 'warning'));
  client.on('refused', (message) => notices.tell(message, 'warning'));
  client.on('welcome', ({ name }) => notices.mention(texts().link.connectedTo(name)));
  client.on('commandRejected', ({ reason, detail }) => {
    console.info('command refused:', reason, detail);
    if (reason === 'not-lease-holder' && isDisplaced()) return;
    notices.tell(wordsOfRejection(reason, client.driver.holder), 'warning');
  });
  client.on('otherDrives', () => {
    if (!isDisplaced()) notices.tell(texts().driving.rejections['not-lease-holder'], 'warning');
  });
  client.on('gripMissing', (device) => {
    const role = link.session.welcome?.access?.role ?? null;
    const drives = link.session.about?.drives ?? true;
    if (link.phase === 'live' && drives)
      notices.tell(missingGripWords(device, driver.holder, role), 'warning');
  });
  client.on('gripLost', (loss) => {
    if (!isDisplaced()) notices.tell(texts().driving.gripLost[loss], 'warning');
  });
  client.on('robotFault', (message) => notices.tell(texts().link.robotReports(message), 'warning'));
  client.on('failed', ({ detail }) => {
    console.error('cloud worker:', detail);
    notices.failure.value = texts().failures.workerFailed;
  });
}

/**
 * How long a line stays, ms. Chosen: two sentences are read in it, and what stays is no news; notices.test.ts
 * holds it.
 */
const SHOWN_MS = 5000;
/**
 * Good news stays for as long before it makes room for what is only mentioned, ms: chosen, a dozen words are read in it. Otherwise
 * a robot that is found at once hides who has signed in.
 */
const LEAST_GOOD_MS = 2000;

export interface Failure {
  readonly title: string;
  readonly text: string;
}

export class Notices {
  /** What keeps the page from working; `null` if nothing does. */
  readonly failure = signal<Failure | null>(null);
  readonly #last = signal<Words | null>(null);
  readonly #gone = signal(false);
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** Runs until the good news that is shown has been read. */
  #reading: ReturnType<typeof setTimeout> | undefined;
  #mentioned: string | null = null;

  /** The last line told, whether it is still shown or not. */
  readonly last: ReadonlySignal<Words | null> = this.#last;
  readonly shown: ReadonlySignal<Words | null> = computed(() => (this.#gone.value ? null : this.#last.value));

  /** Shows a line at once: what somebody has done, or must know. */
  tell(text: string, tone: Tone = 'neutral'): void {
    this.#last.value = { text, tone };
    this.#gone.value = false;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#gone.value = true;
    }, SHOWN_MS);
    clearTimeout(this.#reading);
    // What has happened since is newer than what waited.
    this.#mentioned = null;
    this.#reading = tone === 'good' ? setTimeout(() => this.#onRead(), LEAST_GOOD_MS) : undefined;
  }

  /** Shows good news that came by itself, but not before other good news has been read. */
  mention(text: string): void {
    if (this.#reading === undefined) this.tell(text, 'good');
    else this.#mentioned = text;
  }

  #onRead(): void {
    this.#reading = undefined;
    if (this.#mentioned !== null) this.tell(this.#mentioned, 'good');
  }
}
