/** Grants and robots' keys on the page: the dialog, and the panel that asks for them. */
import type { RobotClient } from '@farpoint/operator';
import { takeGrantFromAddress } from '../access/grant-in-address.ts';
import type { StoredRobots } from '../access/known-robots.ts';
import type { OperatorAccess } from '../access/operator-access.ts';
import type { LinkState } from '../state/link-state.ts';
import { AccessDialog } from './access-dialog.ts';
import { showObstacle } from './obstacle-panel.ts';

export interface AccessUiParts {
  readonly access: OperatorAccess;
  readonly knownRobots: StoredRobots;
  readonly client: RobotClient;
  readonly link: Pick<LinkState, 'obstacle'>;
}

export class AccessUi {
  readonly #parts: AccessUiParts;
  readonly #dialog: AccessDialog;

  constructor(parts: AccessUiParts) {
    this.#parts = parts;
    const { access, knownRobots: known, client } = parts;
    this.#dialog = new AccessDialog({ access, known, onAdded: () => client.link.retry() });
  }

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
    });
    const given = takeGrantFromAddress(window.location, window.history);
    if (given !== null) this.#dialog.open(given);
  }
}
