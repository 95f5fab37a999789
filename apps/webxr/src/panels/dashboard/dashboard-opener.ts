/** Opens and closes the dashboard. Its code is loaded when it is first opened, so that the page starts without it. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, signal, untracked } from '@preact/signals-core';
import type { Settings } from '../../ground/settings.ts';
import { silenceOf } from '../../ground/silence.ts';
import type { Moment } from '../../ground/telemetry/moment.ts';
import type { PresentedInstant } from '../../ground/telemetry/presented-instant.ts';
import type { TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import type { PageState } from '../../state/page-state.ts';
import { elements } from '../ui/elements.ts';
import { LaterPart } from '../ui/later-part.ts';
import type { Dashboard } from './dashboard.ts';

export interface DashboardOpenerParts {
  readonly client: RobotClient;
  readonly state: PageState;
  readonly settings: Pick<Settings, 'mapTiles' | 'synchronised'>;
  readonly recorder: TelemetryRecorder;
  readonly presented: PresentedInstant;
  readonly inVr: ReadonlySignal<boolean>;
}

export class DashboardOpener {
  readonly #parts: DashboardOpenerParts;
  readonly #open = signal(false);
  readonly #dashboard = signal<Dashboard | null>(null);
  /** The tile with where the time goes is to be shown, once the dashboard is. */
  readonly #wantsStages = signal(false);
  readonly #code;
  /** Robot's clock minus page's clock, as last known, ms. */
  #offsetMs: number | null = null;

  constructor(parts: DashboardOpenerParts) {
    this.#parts = parts;
    const { state, client, inVr } = parts;
    this.#code = new LaterPart(() => import('./dashboard.ts'), state.notices);
    const { dashboardOpen, dashboard, alarm } = elements;
    dashboardOpen.addEventListener('click', () => this.toggle());
    alarm.addEventListener('click', () => {
      alarm.blur();
      this.#open.value = true;
    });
    client.on('welcome', () => {
      this.#offsetMs = null;
    });
    // Without a robot there is nothing to show. While the link to one is lost, its last values stay.
    const shown = computed(() => this.#open.value && state.link.connected.value);
    effect(() => {
      dashboardOpen.hidden = !state.link.connected.value;
      dashboardOpen.ariaExpanded = String(shown.value);
      dashboard.hidden = !shown.value || this.#dashboard.value === null;
      document.body.classList.toggle('with-dashboard', !dashboard.hidden);
    });
    effect(() => {
      if (shown.value) this.#load();
    });
    effect(() => {
      const loaded = this.#dashboard.value;
      if (!this.#wantsStages.value || !shown.value || loaded === null) return;
      this.#wantsStages.value = false;
      untracked(() => loaded.showStages());
    });
    effect(() => {
      const loaded = this.#dashboard.value;
      if (loaded !== null) loaded.visible = shown.value && !inVr.value && state.looking.value;
    });
  }

  /** Opens it with the tile that says where the time goes. */
  openStages(): void {
    this.#open.value = true;
    this.#wantsStages.value = true;
  }

  toggle(): void {
    this.#open.value = !this.#open.peek();
  }

  #load(): void {
    if (this.#dashboard.peek() !== null) return;
    void this.#code.use(
      (code) => {
        this.#dashboard.value ??= this.#build(code.Dashboard);
      },
      () => {
        this.#open.value = false;
      },
    );
  }

  #build(Kind: typeof Dashboard): Dashboard {
    const { client, state, settings, recorder } = this.#parts;
    return new Kind({
      element: elements.dashboard,
      recorder,
      mapTiles: () => settings.mapTiles,
      alarms: state.robot.alarms,
      stages: () => client.statistics,
      testLatency: (startedAtMs) => client.latencyTest(startedAtMs),
      session: () => client.link.session,
      momentAt: (nowMs) => this.#momentAt(nowMs),
      close: () => {
        this.#open.value = false;
      },
    });
  }

  #momentAt(nowMs: number): Moment {
    const { client, settings, presented, recorder } = this.#parts;
    this.#offsetMs = client.link.session.clock.offsetMs ?? this.#offsetMs;
    // Before the clocks have been compared, what came last is taken as new.
    const offsetMs = this.#offsetMs ?? recorder.newestMs - recorder.heardMs;
    const heard = silenceOf(nowMs - recorder.heardMs) === 'heard';
    const robotNowMs = Number.isFinite(offsetMs) ? nowMs + offsetMs : 0;
    return { instantMs: settings.synchronised ? presented.at(nowMs) : null, robotNowMs, heard };
  }
}
