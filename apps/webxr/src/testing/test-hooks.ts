/** Puts {@link FarpointTestApi} on the window. */
import type { App } from '../page/app.ts';
import { pageProbes } from './page-probes.ts';
import { pageRecords } from './page-records.ts';
import { pageState } from './page-state.ts';
import { ScriptInput } from './script-input.ts';
import type { FarpointTestApi } from './test-api.ts';

/** A grip that nobody renews lets go by itself. */
const LONGEST_HOLD_MS = 60_000;

export function installTestApi(app: App): void {
  window.farpoint = {
    version: 1,
    state: () => pageState(app),
    stats: () => app.figures(),
    resetStats: () => {
      app.client.statistics.resetDistributions();
      app.stats.resetDistributions();
      app.views.videos.resetDistributions();
    },
    ...sessionControls(app),
    ...scriptedDrive(app),
    ...pageProbes(app),
    ...pageRecords(app),
  };
}

type SessionControl =
  | 'robots'
  | 'connect'
  | 'disconnect'
  | 'requestLease'
  | 'estop'
  | 'latencyTest'
  | 'latencyResults'
  | 'shareLink';

/** What the page's own controls do with the session. */
function sessionControls(app: App): Pick<FarpointTestApi, SessionControl> {
  const { client, views } = app;
  const { link, driver } = client;
  return {
    robots: () => link.robots,
    connect(robotId, timeoutMs = 30_000) {
      app.choose(robotId);
      const stands = () => link.robotId === robotId && link.phase === 'live' && views.cloud.hasPoints;
      return until(stands, timeoutMs, `no session with ${robotId}`);
    },
    disconnect: () => client.leave(),
    requestLease: (take = false) => driver.requestLease(take),
    estop: (latch) => void (latch ? client.estop() : client.releaseEstop()),
    latencyTest: () => client.latencyTest(),
    latencyResults: () => client.statistics.results,
    shareLink: ({ cloud, videos }) => client.shareLink(cloud, videos),
  };
}

/** Drives as a device with a grip and a stick does. */
function scriptedDrive({ client: { driver } }: App): Pick<FarpointTestApi, 'drive' | 'hold'> {
  const script = new ScriptInput();
  driver.add(script);
  let release: ReturnType<typeof setTimeout> | undefined;
  return {
    async drive(wish, ms) {
      script.hold(wish);
      driver.sendDue(performance.now());
      await new Promise((resolve) => setTimeout(resolve, ms));
      script.release();
      driver.sendDue(performance.now());
    },
    hold(wish) {
      clearTimeout(release);
      script.release();
      if (wish !== null) {
        script.hold(wish);
        release = setTimeout(() => script.release(), LONGEST_HOLD_MS);
      }
      driver.sendDue(performance.now());
    },
  };
}

function until(condition: () => boolean, timeoutMs: number, failure: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const began = performance.now();
    const timer = setInterval(() => {
      if (condition()) {
        clearInterval(timer);
        resolve();
      } else if (performance.now() - began > timeoutMs) {
        clearInterval(timer);
        reject(new Error(`${failure} within ${timeoutMs} ms`));
      }
    }, 20);
  });
}
