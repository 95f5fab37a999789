/** What `window.farpoint` records for measurements: packets, presentations and driving. */
import type { App } from '../page/app.ts';
import { DriveRecord } from './drive-record.ts';
import { PacketRecord } from './packet-record.ts';
import { robotNowMs } from './page-probes.ts';
import { PresentationRecord } from './presentation-record.ts';
import type { FarpointTestApi } from './test-api.ts';

type PacketControl = 'recordPackets' | 'recordedPackets';
type PresentationControl = 'recordPresentations' | 'recordedPresentations';
type DriveControl = 'recordDrive' | 'recordedDrive';

export function pageRecords(
  app: App,
): Pick<FarpointTestApi, PacketControl | PresentationControl | DriveControl> {
  return { ...packetRecords(app), ...presentationRecords(app), ...driveRecords(app) };
}

function packetRecords({ client }: App): Pick<FarpointTestApi, PacketControl> {
  let packets: PacketRecord | null = null;
  client.on('cloud', (batch) => packets?.add(batch, performance.timeOrigin));
  return {
    recordPackets(capacity) {
      packets = capacity === null ? null : new PacketRecord(capacity);
    },
    recordedPackets() {
      const { clock } = client.link.session;
      const values = [...(packets?.values ?? [])];
      for (let i = 2; i < values.length; i += 3)
        values[i] = (values[i] as number) + (clock.offsetMs ?? Number.NaN);
      return { values, minRttMs: clock.minRttMs };
    },
  };
}

function presentationRecords(app: App): Pick<FarpointTestApi, PresentationControl> {
  const { state, views } = app;
  let presentations: PresentationRecord | null = null;
  return {
    recordPresentations(capacity) {
      const record = capacity === null ? null : new PresentationRecord(capacity, () => robotNowMs(app));
      presentations = record;
      views.videos.onPresented =
        record === null
          ? null
          : () =>
              record.add(
                state.videos.views.value.map(({ canvas }) => canvas),
                () => views.hold.passedMs,
              );
    },
    recordedPresentations: () => [...(presentations?.rows ?? [])],
  };
}

function driveRecords({ client }: App): Pick<FarpointTestApi, DriveControl> {
  let drive: DriveRecord | null = null;
  return {
    recordDrive(on) {
      drive?.stop();
      if (on) drive = new DriveRecord(client);
    },
    recordedDrive: () =>
      drive === null ? null : { rows: drive.rows, gripsLost: drive.gripsLost, refusals: drive.refusals },
  };
}
