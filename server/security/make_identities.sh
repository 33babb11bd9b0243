#!/usr/bin/env bash
# Makes identities for --security DIR. Usage:
#
#   server/security/make_identities.sh [--protection encrypt|sign|none] DIR [NAME:operator|NAME:watcher]...
#
# The first run makes two authorities and the rules of the domain in DIR/authority; every run makes one folder DIR/NAME
# for each identity, with the six files that --security wants. DIR/authority/*_key.pem can make more identities: keep
# them off the machines that only run programs. An operator may do everything; a watcher may read every topic and write
# nothing but flexcast/recorders, which tells the server that somebody records.
set -euo pipefail

# Nobody joins without a certificate, whatever is chosen here. "encrypt" also keeps data secret and unforgeable; "sign"
# leaves it readable for who can listen to the network, and is hardly faster; "none" is nearly as fast as no security,
# and whoever can send datagrams to the machine can forge samples.
protection=ENCRYPT
days=3650

usage() {
  sed -n 's/^# \{0,1\}//; 2,9p' "${BASH_SOURCE[0]}"
  exit "$1"
}

fail() {
  echo "make_identities.sh: $1" >&2
  exit "${2:-1}"
}

# make_authority NAME: a self-signed certificate and its key.
make_authority() {
  (umask 077 && openssl ecparam -name prime256v1 -genkey -noout -out "$authority/$1_key.pem")
  openssl req -x509 -new -sha256 -days "$days" -key "$authority/$1_key.pem" -subj "/O=flexcast/CN=$1" \
    -out "$authority/$1.pem"
}

# sign FILE.xml FILE.p7s: by the authority of permissions.
sign() {
  openssl smime -sign -text -in "$1" -out "$2" -signer "$authority/permissions_ca.pem" \
    -inkey "$authority/permissions_ca_key.pem"
}

write_governance() {
  cat <<XML
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>230</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>$protection</discovery_protection_kind>
      <liveliness_protection_kind>$protection</liveliness_protection_kind>
      <rtps_protection_kind>NONE</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>$discovery</enable_discovery_protection>
          <enable_liveliness_protection>$discovery</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>$protection</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
XML
}

# write_permissions SUBJECT PUBLISHED_TOPICS
write_permissions() {
  cat <<XML
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="flexcast">
      <subject_name>$1</subject_name>
      <validity>
        <not_before>$(date -u +%Y-%m-%dT00:00:00)</not_before>
        <not_after>$(date -u -d "+$days days" +%Y-%m-%dT00:00:00)</not_after>
      </validity>
      <allow_rule>
        <domains><id_range><min>0</min><max>230</max></id_range></domains>
        <publish><topics><topic>$2</topic></topics></publish>
        <subscribe><topics><topic>*</topic></topics></subscribe>
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
XML
}

# make_identity NAME PUBLISHED_TOPICS
make_identity() {
  local folder=$directory/$1 subject
  mkdir -p "$folder"
  (umask 077 && openssl ecparam -name prime256v1 -genkey -noout -out "$folder/key.pem")
  openssl req -new -sha256 -key "$folder/key.pem" -subj "/O=flexcast/CN=$1" |
    openssl x509 -req -sha256 -days "$days" -CA "$authority/identity_ca.pem" -CAkey "$authority/identity_ca_key.pem" \
      -set_serial "0x$(openssl rand -hex 16)" -extfile "$scratch/extensions" -out "$folder/cert.pem" 2>/dev/null
  # Permissions name their subject in the order of RFC 2253: the most special part first.
  subject=$(openssl x509 -noout -subject -nameopt RFC2253 -in "$folder/cert.pem")
  write_permissions "${subject#subject=}" "$2" >"$scratch/permissions.xml"
  sign "$scratch/permissions.xml" "$folder/permissions.p7s"
  cp "$authority"/{identity_ca.pem,permissions_ca.pem,governance.p7s} "$folder"
}

[[ ${1-} != --help && ${1-} != -h ]] || usage 0
if [[ ${1-} == --protection ]]; then
  protection=${2-}
  protection=${protection^^}
  [[ $protection =~ ^(ENCRYPT|SIGN|NONE)$ ]] || fail "--protection is encrypt, sign or none" 2
  shift 2
fi
[[ $protection == NONE ]] && discovery=false || discovery=true
(($# >= 1)) || usage 2 >&2
directory=$1
authority=$directory/authority
shift
for identity in "$@"; do
  [[ $identity =~ ^[A-Za-z0-9_-]{1,64}:(operator|watcher)$ && $identity != authority:* ]] ||
    fail "'$identity' is not NAME:operator or NAME:watcher, the name of letters, digits, _ and - (not: authority)" 2
done
command -v openssl >/dev/null || fail "openssl is missing: apt-get install openssl"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo "basicConstraints = critical, CA:FALSE" >"$scratch/extensions"
if [[ ! -e $authority/governance.p7s ]]; then
  mkdir -p "$authority"
  make_authority identity_ca
  make_authority permissions_ca
  write_governance >"$scratch/governance.xml"
  sign "$scratch/governance.xml" "$authority/governance.p7s"
fi
for identity in "$@"; do
  topics='*'
  [[ $identity == *:operator ]] || topics=flexcast/recorders
  make_identity "${identity%:*}" "$topics"
  echo "$directory/${identity%:*}"
done
