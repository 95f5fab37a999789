/** Tells people what happens to the session and to their commands, as short notices. */
import { finalLosses, type RobotClient } from '@farpoint/operator';
import {
  failureWords,
  gripLossWords,
  rejectionWords,
  wordsOfLoss,
  wordsOfRejection,
} from '../words/words.ts';
import type { Notices } from './notices.ts';

export function tellNotices(client: RobotClient, notices: Notices): void {
  client.on('loss', (loss) => {
    // A panel shows the final ones.
    if (!finalLosses.has(loss)) notices.tell(wordsOfLoss(loss, client.link), 'warning');
  });
  client.on('grantExpires', (inS) => notices.tell(`Your grant ends in ${inS} s.`, 'warning'));
  client.on('refused', (message) => notices.tell(message, 'warning'));
  client.on('welcome', ({ name }) => notices.tell(`Connected to ${name}`, 'good'));
  client.on('commandRejected', ({ reason, detail }) => {
    console.info('command refused:', reason, detail);
    notices.tell(wordsOfRejection(reason, client.driver.holder), 'warning');
  });
  client.on('otherDrives', () => notices.tell(rejectionWords['not-lease-holder'], 'warning'));
  client.on('gripLost', (loss) => notices.tell(gripLossWords[loss], 'warning'));
  client.on('robotFault', (message) => notices.tell(`The robot reports: ${message}`, 'warning'));
  client.on('failed', ({ detail }) => {
    console.error('cloud worker:', detail);
    notices.failure.value = failureWords.workerFailed;
  });
}
