import type { PulledMetrics } from '@farpoint/service';
import type { OperatorSession } from '../../serve/session/operator-session.ts';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of camera pictures: made, lost, sent. None if the robot has no camera. */
export function addPictureMetrics(
  metrics: PulledMetrics,
  { streams: { cameras }, operators }: MeasuredRobot,
): void {
  const { pictures } = cameras;
  if (pictures === null) return;
  const made = pictures.counters;
  const total = (read: (operator: OperatorSession) => number) => () =>
    [...operators.values()].reduce((sum, operator) => sum + read(operator), 0);

  metrics.sum('pictures_made', 'Camera pictures prepared for sending', () => made.made);
  metrics.sum(
    'pictures_untouched',
    'Prepared pictures that are the camera’s own files, unchanged',
    () => made.untouched,
  );
  metrics.sum('picture_bytes', 'Bytes of the prepared pictures', () => made.bytes);
  metrics.sum('picture_thread_seconds', 'Processor time of the picture thread', () => made.workSeconds);
  metrics.sum('picture_thread_restarts', 'Restarts of the picture thread', () => made.restarts);
  metrics.sums('pictures_lost', 'Pictures that could not be prepared, by reason', 'reason', () =>
    made.lost.entries(),
  );
  metrics.gauge(
    'pictures_sent',
    'Pictures sent to operators connected now',
    total(({ pictures: sender }) => sender.picturesSent),
  );
  metrics.gauge(
    'picture_bytes_sent',
    'Bytes on the wire of pictures to operators connected now',
    total(({ pictures: sender }) => sender.bytesSent),
  );
  metrics.gauges(
    'pictures_unsent',
    'Pictures not sent, or only in part, by reason, for operators connected now',
    'reason',
    () => [...operators.values()].flatMap(({ pictures: sender }) => Object.entries(sender.drops)),
  );
}
