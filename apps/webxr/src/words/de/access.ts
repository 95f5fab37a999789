import type { Texts } from '../en/catalogue.ts';

export const access: Texts['access'] = {
  roles: {
    watch: 'darf zusehen',
    drive: 'darf fahren',
    supervise: 'darf fahren und beaufsichtigen',
  },
  grantFaults: {
    'no-grant': 'Das ist weder eine Berechtigung noch ein Ticket. Fügen Sie die ganze Zeile ein.',
    'other-key': 'Diese Berechtigung wurde für einen anderen Schlüssel als den dieses Browsers erstellt.',
    'bad-ticket': 'Dieses Ticket ist beschädigt. Fügen Sie die ganze Zeile ein oder bitten Sie um ein neues.',
    expired: 'Diese Berechtigung ist abgelaufen. Bitten Sie um eine neue.',
    'too-many': 'Dieser Browser nimmt keine weiteren Berechtigungen auf. Entfernen Sie zuerst eine.',
  },
  signInErrors: {
    'not-permitted':
      'Sie sind angemeldet, aber hier ist nichts für Sie eingerichtet. Wenden Sie sich an die Person, die Berechtigungen ausstellt.',
    cancelled: 'Die Anmeldung wurde abgebrochen.',
    expired: 'Die Anmeldung hat länger als zehn Minuten gedauert. Melden Sie sich noch einmal an.',
    'provider-unreachable': 'Der Anmeldedienst ist nicht erreichbar. Versuchen Sie es später noch einmal.',
    'provider-refused':
      'Der Anmeldedienst hat abgelehnt. Informieren Sie die Person, die ihn eingerichtet hat.',
    unproven:
      'Der Anmeldedienst hat nicht bewiesen, wer Sie sind. Melden Sie sich noch einmal an; bleibt es dabei, informieren Sie die Person, die ihn eingerichtet hat.',
    'bad-request':
      'Die Seite und der Anmeldedienst passen nicht zueinander. Informieren Sie die Person, die beide eingerichtet hat.',
    'too-many':
      'Aus Ihrem Netzwerk kamen zu viele Anmeldungen. Warten Sie eine Minute und melden Sie sich dann noch einmal an.',
    'issuer-failed':
      'Der Dienst, der Berechtigungen ausstellt, ist ausgefallen. Informieren Sie die Person, die ihn eingerichtet hat.',
  },
  until: (date) => `bis ${date}`,
  ended: (date) => `abgelaufen am ${date}`,
  grant: (name, role, robots, until) => `${name} ${role}: ${robots}, ${until}`,
  signedIn: (name, role, robots) => `Angemeldet: ${name} ${role}: ${robots}`,
  added: 'Hinzugefügt.',
  addedForNow: 'Für diesen Besuch hinzugefügt: Der Browser speichert für diese Seite nichts.',
  needsHttps: 'Berechtigungen brauchen https: Öffnen Sie die Seite unter ihrer https-Adresse.',
  noRobots: 'Noch keine. Ein Roboter ist nach der ersten Sitzung mit ihm bekannt.',
  remove: 'Entfernen',
  forget: 'Vergessen',
  notAdmitted: 'Der Roboter lässt Sie nicht zu',
  onlyWithGrant: 'Er lässt nur Personen mit einer Berechtigung zu',
  askForGrant: (detail) =>
    `Der Roboter sagt: ${detail}. Bitten Sie die Person, die Berechtigungen ausstellt, um eine und fügen Sie sie in diesem Browser hinzu.`,
  signInForGrant: (detail) =>
    `Der Roboter sagt: ${detail}. Melden Sie sich an, um eine zu erhalten. Oder bitten Sie die Person, die Berechtigungen ausstellt, um eine und fügen Sie sie in diesem Browser hinzu.`,
  otherRobot: 'Das könnte ein anderer Roboter sein',
  otherKeyThanGranted:
    'Er weist einen anderen Schlüssel nach als den in Ihrer Berechtigung. Fahren Sie ihn nicht. Informieren Sie die Person, die die Berechtigung ausgestellt hat.',
  otherKeyThanKnown:
    'Er weist einen anderen Schlüssel nach als der Roboter, den dieser Browser unter diesem Namen kennt. Das ist nur normal, wenn sein Computer ersetzt oder neu eingerichtet wurde. Vergleichen Sie den neuen Schlüssel mit dem, den der Roboter beim Start protokolliert.',
  unproven: (detail) =>
    `Dieser Browser kennt den Roboter an seinem Schlüssel, aber der Roboter hat ihn nicht nachgewiesen: ${detail}. Jemand könnte zwischen Ihnen und dem Roboter stehen.`,
  noProof: 'kein Nachweis',
};
