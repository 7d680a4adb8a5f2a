#!/bin/sh
# A command in a bare Debian 12 that is made for it: root.sh FOLDER PACKAGES COMMAND [ARGUMENT ...]
#
# It holds no more than the packages named (with commas) and is made once in FOLDER. Needs root, debootstrap and unshare.
# MIRROR: where Debian's packages come from, default that of debootstrap. BIND: further paths of this machine that are
# seen inside, such as those of a package index. Settings of pip (PIP_..., /etc/pip.conf) and certificates are taken over.
set -eu
root=$1 packages=$2
shift 2
if [ ! -e "$root/.made" ]; then
    debootstrap --variant=minbase --include="ca-certificates,$packages" bookworm "$root" ${MIRROR:-} >"$root.log" 2>&1 ||
        { tail -3 "$root.log"; exit 1; }
    touch "$root/.made"
fi
for file in /etc/pip.conf /etc/resolv.conf /etc/hosts /etc/ssl/certs/ca-certificates.crt; do
    if [ -e "$file" ]; then mkdir -p "$root$(dirname "$file")" && cp -L "$file" "$root$file"; fi
done
export root BIND="${BIND:-}"
exec unshare --mount sh -eu -c '
    for path in /proc /dev /sys $BIND; do mkdir -p "$root$path" && mount --rbind "$path" "$root$path"; done
    # A setting of pip may hold spaces.
    IFS="
"
    exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        $(env | grep "^PIP_" || true) "$@"' sh "$@"
