/** Grants and robots' keys on the page: the dialog, the panel that asks for them, and the sign-in. */
import type { RobotClient } from '@farpoint/operator';
import type { SignInAnswer } from '@farpoint/protocol';
import { computed } from '@preact/signals-core';
import { takeGrantFromAddress } from '../../ground/access/grant-in-address.ts';
import type { OperatorAccess } from '../../ground/access/operator-access.ts';
import type { SignIn } from '../../ground/access/sign-in.ts';
import type { StoredRobots } from '../../ground/access/stored-robots.ts';
import type { LinkState } from '../../state/link-state.ts';
import { roleWords, signInErrorWords } from '../../words/access-words.ts';
import type { Words } from '../../words/words.ts';
import { AccessDialog } from './access-dialog.ts';
import { showObstacle } from './obstacle-panel.ts';

export interface AccessUiParts {
  readonly access: OperatorAccess;
  readonly knownRobots: StoredRobots;
  readonly signIn: SignIn;
  readonly client: RobotClient;
  readonly link: Pick<LinkState, 'obstacle' | 'signInUrl'>;
  tell(words: Words): void;
}

export class AccessUi {
  readonly #parts: AccessUiParts;
  readonly #dialog: AccessDialog;

  constructor(parts: AccessUiParts) {
    this.#parts = parts;
    const { access, knownRobots: known, client, link } = parts;
    this.#dialog = new AccessDialog({
      access,
      known,
      onAdded: () => client.link.retry(),
      signIn: () => void this.#signIn(),
      // Without https, the browser has no key that a grant could be made for.
      signInUrl: computed(() => (window.isSecureContext ? link.signInUrl.value : null)),
    });
  }

  /** Call it before the client starts: a grant with which the browser comes back counts for the first session. */
  start(): void {
    const { client, link, knownRobots } = this.#parts;
    this.#dialog.start();
    showObstacle(link.obstacle, {
      leave: () => client.leave(),
      retry: () => client.link.retry(),
      trust: () => {
        const { changedRobotKey } = client.link;
        if (changedRobotKey === null) return;
        knownRobots.remember(changedRobotKey.robotId, changedRobotKey.shown);
        client.link.retry();
      },
      openAccess: () => this.#dialog.open(),
      signIn: () => void this.#signIn(),
    });
    const answer = takeGrantFromAddress(window.location, window.history);
    if (answer !== null) void this.#take(answer);
  }

  async #signIn(): Promise<void> {
    const { access, link, signIn } = this.#parts;
    await access.makeKey();
    const [url, key] = [link.signInUrl.peek(), access.ownKey.peek()];
    if (url === null || key === null) return;
    window.location.assign(signIn.begin(url, key, window.location.href, crypto.randomUUID()));
  }

  /** What the page did not ask for is offered, and nothing more. */
  async #take(answer: SignInAnswer): Promise<void> {
    const { access, client, signIn, tell } = this.#parts;
    const isAsked = signIn.isAnsweredBy(answer.state);
    if ('error' in answer) {
      if (isAsked) this.#dialog.open('', { text: signInErrorWords[answer.error], tone: 'warning' });
      return;
    }
    const taken = isAsked ? await access.takeAsked(answer.grant) : null;
    if (taken === null || 'fault' in taken) {
      this.#dialog.open(answer.grant);
      return;
    }
    const { name, role, robots } = taken.claims;
    tell({ text: `Signed in: ${name} ${roleWords[role]}: ${robots.join(', ')}`, tone: 'good' });
    client.link.retry();
  }
}
