# Drives `prohull sample` of robots

# --- robots ---
for robot in arm gripper mobile-base; do
  expect 0 "sample $robot" $prohull sample $robot -o robots-$robot/
  says out "sample $robot" "robots-$robot/$robot.urdf: $robot with "
  expect 0 "a mesh of $robot" $prohull info "$(find robots-$robot -name '*.stl' | sort | head -n 1)"
done
expect 3 "a folder that is in use" $prohull sample gripper -o robots-arm
says err "a folder that is in use" "robots-arm: cannot write: it is there and is no empty folder elsewhere; name a new folder"
absent "robots-arm/gripper.urdf" "a folder that is in use"
expect 2 "a robot with --faces" $prohull sample arm --faces 100 -o robots-faces
says err "a robot with --faces" "leave --faces out"
expect 2 "a robot to standard output" $prohull sample arm -o -
says err "a robot to standard output" "name the folder, as in -o arm"
expect 3 "a robot in no folder" $prohull sample arm -o nowhere/arm
absent "robots-faces" "a robot that was refused"
absent ".robots-*" "unfinished robots"
