/** Grants and robots' keys on the page: the dialog, the panel that asks for them, and the sign-in. */
import type { RobotClient } from '@farpoint/operator';
import type { SignInAnswer } from '@farpoint/protocol';
import { computed, effect, type ReadonlySignal, signal } from '@preact/signals-core';
import { takeGrantFromAddress } from '../../ground/access/grant-in-address.ts';
import type { OperatorAccess, ReadResult } from '../../ground/access/operator-access.ts';
import type { SignIn } from '../../ground/access/sign-in.ts';
import type { StoredRobots } from '../../ground/access/stored-robots.ts';
import type { LinkState } from '../../state/link-state.ts';
import { grantWords } from '../../words/access-words.ts';
import { texts } from '../../words/language.ts';
import { dateText } from '../../words/numbers.ts';
import type { Words } from '../../words/words.ts';
import { elements } from './elements.ts';
import { showObstacle } from './obstacle-panel.ts';
import { openDialog } from './open-dialog.ts';

export interface AccessDialogParts {
  readonly access: OperatorAccess;
  readonly known: StoredRobots;
  /** Where operators sign in for a grant; `null` if there is no such place. */
  readonly signInUrl: ReadonlySignal<string | null>;
  /** Leaves the page to sign in. */
  signIn(): void;
  /** A grant was added: robots that refused this operator may admit it now. */
  onAdded(): void;
}

/** The dialog for grants: this browser's key, the grants that it holds, and the robots that it knows. */
class AccessDialog {
  readonly #parts: AccessDialogParts;
  readonly #robots = signal<ReadonlyMap<string, string>>(new Map());
  #read: ReadResult | null = null;
  /** Counts what was typed, because reading takes a moment. */
  #typed = 0;

  constructor(parts: AccessDialogParts) {
    this.#parts = parts;
  }

  start(): void {
    const { access, signInUrl } = this.#parts;
    const { accessOpen, accessText, accessAdd, accessKey, accessCopy, accessGrants, accessRobots } = elements;
    accessOpen.addEventListener('click', () => this.open());
    accessText.addEventListener('input', () => void this.#take());
    accessAdd.addEventListener('click', () => void this.#add());
    accessCopy.addEventListener('click', () => void copy(accessKey));
    const { accessSignIn, accessSignInRow, accessSignInHost } = elements;
    accessSignIn.addEventListener('click', () => this.#parts.signIn());
    effect(() => {
      accessSignInRow.hidden = signInUrl.value === null;
      accessSignInHost.textContent = signInUrl.value === null ? '' : new URL(signInUrl.value).host;
    });
    effect(() => {
      accessKey.value = access.ownKey.value ?? '';
    });
    effect(() => {
      const nowS = Date.now() / 1000;
      accessGrants.replaceChildren(
        ...access.grants.value.map(({ id, claims }) =>
          itemOf(grantWords(claims, nowS, dateText), texts().access.remove, () => void access.remove(id)),
        ),
      );
    });
    effect(() => {
      const robots = [...this.#robots.value];
      const none = document.createElement('li');
      none.textContent = texts().access.noRobots;
      accessRobots.replaceChildren(
        ...robots.map(([robotId, key]) =>
          itemOf({ text: `${robotId}: ${key}`, tone: 'neutral' }, texts().access.forget, () => {
            this.#parts.known.forget(robotId);
            this.#robots.value = this.#parts.known.all();
          }),
        ),
        ...(robots.length === 0 ? [none] : []),
      );
    });
  }

  /**
   * @param text a grant or ticket that came another way; it still has to be added
   * @param words what to say first
   */
  open(text = '', words: Words | null = null): void {
    const { settings, access, accessText } = elements;
    settings.close('cancel');
    this.#robots.value = this.#parts.known.all();
    accessText.value = text;
    openDialog(access);
    if (window.isSecureContext) {
      void this.#parts.access.makeKey().then(async () => {
        await this.#take();
        if (words !== null) this.#say(words);
      });
    } else {
      this.#say({ text: texts().access.needsHttps, tone: 'bad' });
      accessText.disabled = true;
    }
  }

  async #take(): Promise<void> {
    const { accessText, accessAdd } = elements;
    const typed = ++this.#typed;
    const text = accessText.value;
    const read = text.trim() === '' ? null : await this.#parts.access.read(text);
    if (typed !== this.#typed) return;
    this.#read = read;
    accessAdd.disabled = read === null || 'fault' in read;
    if (read === null) this.#say(null);
    else if ('fault' in read) this.#say({ text: texts().access.grantFaults[read.fault], tone: 'warning' });
    else this.#say(grantWords(read.claims, Date.now() / 1000, dateText));
  }

  async #add(): Promise<void> {
    if (this.#read === null || 'fault' in this.#read) return;
    const kept = await this.#parts.access.add(this.#read);
    if (typeof kept === 'string') {
      this.#say({ text: texts().access.grantFaults[kept], tone: 'warning' });
      return;
    }
    elements.accessText.value = '';
    await this.#take();
    this.#say(
      kept
        ? { text: texts().access.added, tone: 'good' }
        : { text: texts().access.addedForNow, tone: 'warning' },
    );
    this.#parts.onAdded();
  }

  #say(words: Words | null): void {
    const { accessRead } = elements;
    accessRead.hidden = words === null;
    accessRead.textContent = words?.text ?? '';
    accessRead.dataset.tone = words?.tone ?? 'neutral';
  }
}

function itemOf({ text, tone }: Words, action: string, onAction: () => void): HTMLLIElement {
  const [item, label, button] = [
    document.createElement('li'),
    document.createElement('span'),
    document.createElement('button'),
  ];
  label.textContent = text;
  label.dataset.tone = tone;
  button.type = 'button';
  button.className = 'quiet';
  button.textContent = action;
  button.addEventListener('click', onAction);
  item.append(label, button);
  return item;
}

async function copy(field: HTMLInputElement): Promise<void> {
  field.select();
  // Without permission, the text stays selected, to be copied by hand.
  await navigator.clipboard?.writeText(field.value).catch(() => undefined);
}

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
      if (isAsked)
        this.#dialog.open('', { text: texts().access.signInErrors[answer.error], tone: 'warning' });
      return;
    }
    const taken = isAsked ? await access.takeAsked(answer.grant) : null;
    if (taken === null || 'fault' in taken) {
      this.#dialog.open(answer.grant);
      return;
    }
    const { name, role, robots } = taken.claims;
    const { signedIn, roles } = texts().access;
    tell({ text: signedIn(name, roles[role], robots.join(', ')), tone: 'good' });
    client.link.retry();
  }
}
